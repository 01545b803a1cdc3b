#include <filesystem>
#include <fstream>

#include <pairsum/core/names.hpp>
#include <pairsum/files/whole_file.hpp>
#include <pairsum/files/write_hdf.hpp>

namespace pairsum::files {
namespace {

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text)
    all += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return all;
}

}  // namespace

void write_xmf(const std::string& path, const std::vector<snapshot_file>& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
      "<Grid Name=\"particles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  for (const snapshot_file& s : series) {
    const std::string n = std::to_string(s.particles);
    const std::string file = escaped(std::filesystem::absolute(s.path).lexically_proximate(folder).string());
    const auto item = [&](const std::string& name, int columns, const char* type, int bytes) {
      return "<DataItem Format=\"HDF\" NumberType=\"" + std::string(type) + "\" Precision=\"" + std::to_string(bytes) +
             "\" Dimensions=\"" + n + (columns > 1 ? " " + std::to_string(columns) : "") + "\">" + file +
             ":/PartType0/" + name + "</DataItem>";
    };
    const auto attribute = [&](const std::string& name, int columns, const char* type, int bytes) {
      return "<Attribute Name=\"" + name + "\" AttributeType=\"" + (columns > 1 ? "Vector" : "Scalar") +
             "\" Center=\"Node\">" + item(name, columns, type, bytes) + "</Attribute>\n";
    };
    text += "<Grid Name=\"particles\" GridType=\"Uniform\"><Time Value=\"" + number_text(s.time) + "\"/>\n" +
            "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" + n + "\" NodesPerElement=\"1\"/>\n" +
            "<Geometry GeometryType=\"XYZ\">" + item("Coordinates", 3, "Float", 8) + "</Geometry>\n" +
            attribute("Velocities", 3, "Float", 8) + attribute("Density", 1, "Float", 8) +
            attribute("Masses", 1, "Float", 8) + attribute("Kind", 1, "UChar", 1) +
            attribute("ParticleIDs", 1, "UInt", 4) + "</Grid>\n";
  }
  text += "</Grid>\n</Domain></Xdmf>\n";
  write_whole(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw error("cannot write " + path + ": " + std::strerror(errno));
  });
}

}  // namespace pairsum::files
