#include <pairsum/files/write_hdf.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <span>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/hdf5_file.hpp>
#include <pairsum/files/hdf5_handle.hpp>
#include <pairsum/files/whole_file.hpp>

namespace pairsum::files {
namespace {

constexpr hsize_t rows_at_once = 1 << 16;
constexpr std::size_t longest_text = 60'000;  ///< an attribute holds 64 KB

/// A file that is being written. Every call that fails throws.
class hdf5_writer {
 public:
  hdf5_writer(const std::string& path, std::string final_path)
      : final_path_(std::move(final_path)),
        file_(quietly([&] { return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT); }), H5Fclose) {
    check(file_);
  }

  void group(const std::string& path) {
    check(hdf5_handle(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose));
  }
  void link(const std::string& from, const std::string& to) {
    check(H5Lcreate_hard(file_, from.c_str(), file_, to.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }
  void done() { check(H5Fflush(file_, H5F_SCOPE_LOCAL)); }

  template <class T>
  void attribute(const std::string& object, const char* name, const std::vector<T>& values) {
    const hsize_t n = values.size();
    const hdf5_handle space(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr), H5Sclose);
    attribute(object, name, type_of(T()), space, values.data());
  }
  void attribute(const std::string& object, const char* name, const std::string& text) {
    const hdf5_handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    check(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)));
    check(H5Tset_strpad(type, H5T_STR_NULLPAD));
    attribute(object, name, type, space, text.c_str());
  }

  /// Rows that are made piece by piece: make(row, column).
  template <class T>
  void dataset(const std::string& path, hsize_t rows, hsize_t columns, bool packed,
               const std::function<T(std::size_t, int)>& make) {
    const std::array<hsize_t, 2> extent{rows, columns}, chunk{std::clamp<hsize_t>(rows, 1, rows_at_once), columns};
    const int rank = columns > 1 ? 2 : 1;
    const hdf5_handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose),
        made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (packed) {
      check(H5Pset_chunk(made, rank, chunk.data()));
      check(H5Pset_shuffle(made));
      check(H5Pset_deflate(made, 1));
    }
    const hdf5_handle set(H5Dcreate2(file_, path.c_str(), type_of(T()), space, H5P_DEFAULT, made, H5P_DEFAULT),
                          H5Dclose);
    check(set);
    std::vector<T> block(chunk[0] * columns);
    for (hsize_t begin = 0; begin < rows; begin += rows_at_once) {
      const std::array<hsize_t, 2> first{begin, 0}, count{std::min(rows_at_once, rows - begin), columns};
      for (hsize_t i = 0; i < count[0]; ++i)
        for (hsize_t d = 0; d < columns; ++d) block[i * columns + d] = make(begin + i, static_cast<int>(d));
      const hdf5_handle memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
      check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr));
      check(H5Dwrite(set, type_of(T()), memory, space, H5P_DEFAULT, block.data()));
    }
  }

 private:
  template <class F>
  static hid_t quietly(F&& f) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return f();
  }
  static hid_t type_of(double) { return H5T_NATIVE_DOUBLE; }
  static hid_t type_of(std::int32_t) { return H5T_NATIVE_INT32; }
  static hid_t type_of(std::uint32_t) { return H5T_NATIVE_UINT32; }
  static hid_t type_of(std::int64_t) { return H5T_NATIVE_INT64; }
  static hid_t type_of(std::uint64_t) { return H5T_NATIVE_UINT64; }
  static hid_t type_of(std::uint8_t) { return H5T_NATIVE_UINT8; }

  void attribute(const std::string& object, const char* name, hid_t type, hid_t space, const void* values) {
    const hdf5_handle at(
        H5Acreate_by_name(file_, object.c_str(), name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(at);
    check(H5Awrite(at, type, values));
  }
  void check(hid_t done) const {
    if (done < 0) throw error("cannot write " + final_path_ + ": " + hdf5_last_words());
  }

  std::string final_path_;
  hdf5_handle file_;
};

void write_header(hdf5_writer& out, const initial_condition& c, const snapshot& about, std::uint64_t rows,
                  std::uint64_t lost) {
  const auto dim = static_cast<std::size_t>(c.particles.dim);
  const std::string header = "/Header";
  out.group(header);
  const auto numbers = [&](const char* name, const std::vector<double>& values) {
    out.attribute(header, name, values);
  };
  const auto counts = [&](const char* name, std::uint64_t n) {
    out.attribute(header, name, std::vector<std::uint64_t>{n, 0, 0, 0, 0, 0});
  };
  counts("NumPart_ThisFile", rows);
  counts("NumPart_Total", rows);
  counts("NumPart_Total_HighWord", 0);
  out.attribute(header, "NumFilesPerSnapshot", std::vector<std::int32_t>{1});
  numbers("MassTable", std::vector<double>(6, 0.0));
  numbers("Time", {about.time});
  numbers("Redshift", {0});
  std::vector<double> edges(3, 0.0);
  std::vector<std::int32_t> periodic;
  for (std::size_t d = 0; d < dim; ++d) {
    edges[d] = c.omega_high[d] - c.omega_low[d];
    periodic.push_back(c.periodic[static_cast<int>(d)]);
  }
  numbers("BoxSize", edges);
  numbers("BoxLow", c.omega_low);
  numbers("BoxHigh", c.omega_high);
  out.attribute(header, "Periodic", periodic);
  out.attribute(header, "Dimension", std::vector<std::int32_t>{c.particles.dim});
  numbers("SupportRadius", {c.H});
  numbers("Rho0", {c.eos.rho0});
  numbers("B", {c.eos.B});
  numbers("Gravity", {c.gravity});
  if (about.dx > 0) numbers("Spacing", {about.dx});
  out.attribute(header, "Step", std::vector<std::uint64_t>{about.step});
  out.attribute(header, "Lost", std::vector<std::uint64_t>{about.lost + lost});
  numbers("NextTimeStep", {about.next_dt});
  out.attribute(header, "Settings", about.settings);
  std::string facts;
  for (const fact& f : about.facts)
    facts += f.what + " = " + f.value + " (" + std::string(word_of(f.how)) + ": " + f.from + ")\n";
  facts.resize(std::min(facts.size(), longest_text));
  out.attribute(header, "Facts", facts);
}

/// A vertex for every particle: Types 1 of VTK.
void write_vtk(hdf5_writer& out, std::uint64_t rows) {
  const std::string vtk = "/VTKHDF";
  const auto n = static_cast<std::int64_t>(rows);
  out.group(vtk);
  out.attribute(vtk, "Version", std::vector<std::int64_t>{1, 0});
  out.attribute(vtk, "Type", "UnstructuredGrid");
  for (const char* const name : {"/NumberOfPoints", "/NumberOfCells", "/NumberOfConnectivityIds"})
    out.dataset<std::int64_t>(vtk + name, 1, 1, false, [&](std::size_t, int) { return n; });
  const auto number = [](std::size_t i, int) { return static_cast<std::int64_t>(i); };
  out.dataset<std::int64_t>(vtk + "/Connectivity", rows, 1, true, number);
  out.dataset<std::int64_t>(vtk + "/Offsets", rows + 1, 1, true, number);
  out.dataset<std::uint8_t>(vtk + "/Types", rows, 1, true, [](std::size_t, int) { return std::uint8_t{1}; });
  out.link("/PartType0/Coordinates", vtk + "/Points");
  out.group(vtk + "/PointData");
  for (const std::string name : {"Velocities", "Density", "Masses", "Kind", "ParticleIDs"})
    out.link("/PartType0/" + name, vtk + "/PointData/" + name);
}

}  // namespace

void write_hdf(const std::string& path, const initial_condition& c, const snapshot& about) {
  const particle_table& p = c.particles;
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.kind[i] != particle_kind::lost) ids.push_back(static_cast<std::uint32_t>(i));
  write_whole(path, [&](const std::string& temporary) {
    hdf5_writer out(temporary, path);
    write_header(out, c, about, ids.size(), p.size() - ids.size());
    out.group("/PartType0");
    const auto column = [&](const char* name, const std::vector<double>& all) {
      out.dataset<double>(std::string("/PartType0/") + name, ids.size(), 1, false,
                          [&](std::size_t i, int) { return all[ids[i]]; });
    };
    const auto columns = [&](const char* name, const std::vector<std::vector<double>>& all) {
      out.dataset<double>(std::string("/PartType0/") + name, ids.size(), 3, false, [&](std::size_t i, int d) {
        return d < p.dim ? all[static_cast<std::size_t>(d)][ids[i]] : 0.0;
      });
    };
    columns("Coordinates", p.x);
    columns("Velocities", p.v);
    column("Density", p.rho);
    column("Masses", p.m);
    out.dataset<std::uint32_t>("/PartType0/ParticleIDs", ids.size(), 1, false,
                               [&](std::size_t i, int) { return about.ids.empty() ? ids[i] : about.ids[ids[i]]; });
    out.dataset<std::uint8_t>("/PartType0/Kind", ids.size(), 1, false,
                              [&](std::size_t i, int) { return static_cast<std::uint8_t>(p.kind[ids[i]]); });
    write_vtk(out, ids.size());
    out.done();
  });
}

snapshot read_about(const std::string& path) {
  const hdf5_file file(path);
  const auto number = [&](const char* name) {
    const auto found = file.has("Header") ? file.numbers("Header", name) : std::nullopt;
    if (!found || found->empty()) throw error(path + ": is no snapshot of pairsum: its Header has no " + name);
    return found->front();
  };
  snapshot about;
  about.time = number("Time");
  about.step = static_cast<std::uint64_t>(number("Step"));
  about.lost = static_cast<std::uint64_t>(number("Lost"));
  about.next_dt = number("NextTimeStep");
  about.settings = file.text("Header", "Settings").value_or("");
  const std::string dataset = "PartType0/ParticleIDs";
  std::vector<double> ids(file.shape_of(dataset).rows);
  const std::size_t which = 0;
  double* const to = ids.data();
  file.read(dataset, {&which, 1}, {&to, 1});
  about.ids.assign(ids.begin(), ids.end());
  return about;
}

}  // namespace pairsum::files
