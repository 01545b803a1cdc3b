// DualSPHysics' binary files: cases of GenCase and Part_*.bi4. Public: its JBinaryData and JPartDataBi4; pydsphtools.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <pairsum/core/names.hpp>
#include <pairsum/files/bi4_items.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/shown.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

bool recognises(std::span<const std::byte> head, std::string_view) {
  constexpr std::string_view magic = bi4_items::magic;
  return head.size() >= magic.size() && std::memcmp(head.data(), magic.data(), magic.size()) == 0;
}

/// A number of the header that means something: files of cases have 0 for what is set later.
std::optional<double> positive(const bi4_items& file, std::string_view name) {
  const bi4_value* value = file.value(name);
  if (!value || !(value->number[0] > 0) || !std::isfinite(value->number[0])) return {};
  return value->number[0];
}

double number_or_0(const bi4_items& file, std::string_view name) {
  const bi4_value* value = file.value(name);
  return value ? value->number[0] : 0;
}

void read_header(const bi4_items& file, file_content& content) {
  content.dx = positive(file, "Dp");
  content.h_of_all = positive(file, "H");
  content.support = 2;
  content.rho0 = positive(file, "Rhop0");
  content.B = positive(file, "B");
  content.m_of_all = positive(file, "MassFluid");
  content.m_of_boundary = positive(file, "MassBound");
  if (const bi4_value* time = file.value("TimeStep"); time && std::isfinite(time->number[0]))
    content.time = time->number[0];
  if (const bi4_value* flat = file.value("Data2d")) content.dim = flat->number[0] != 0 ? 2 : 3;
  for (const auto& [what, name] : {std::pair{"program", "AppName"}, std::pair{"case", "CaseName"}})
    if (const bi4_value* text = file.value(name); text && !text->text.empty())
      content.facts.push_back({what, shown(text->text), origin::read, name});
  if (const auto gamma = positive(file, "Gamma"))
    content.facts.push_back({"gamma", number_text(*gamma), origin::read, "Gamma"});
  if (const double pieces = number_or_0(file, "Npiece"); pieces > 1)
    content.facts.push_back(
        {"piece", number_text(number_or_0(file, "Piece")) + " of " + number_text(pieces), origin::read, "Piece"});
  if (number_or_0(file, "Symmetry") != 0)
    content.facts.push_back(
        {"symmetry", "half of the particles; the mirrored half is not made", origin::read, "Symmetry"});
}

/// The domain, and along which axes it is periodic: bits 1, 2 and 4 of PeriMode for x, y and z. `kept`: the axes there
/// are.
void read_domain(const bi4_items& file, const std::vector<int>& kept, file_content& content) {
  constexpr int all_axes = 7;  // files of cases say 96: nothing is set yet
  const bi4_value *low = file.value("MapPosMin"), *high = file.value("MapPosMax"), *mode = file.value("PeriMode");
  const bool has_box =
      low && high && std::ranges::all_of(kept, [&](int d) {
        const auto axis = static_cast<std::size_t>(d);
        return low->number[axis] < high->number[axis] && std::isfinite(high->number[axis] - low->number[axis]);
      });
  if (has_box)
    for (std::size_t d = 0; d < 3; ++d) {
      content.box_low.push_back(low->number[d]);
      content.box_high.push_back(high->number[d]);
    }
  if (!mode || !(mode->number[0] >= 0 && mode->number[0] <= all_axes)) return;
  const int bits = static_cast<int>(mode->number[0]);
  content.periodic = axes{};
  for (const int axis : kept) {
    const auto d = static_cast<std::size_t>(axis);
    if ((bits & (1 << axis)) == 0) continue;
    content.periodic->on[d] = true;
    const std::string name = std::string("Peri") + "XYZ"[d] + "inc";
    const bi4_value* to_image = file.value(name);
    if (!to_image) continue;
    for (std::size_t other = 0; other < 3; ++other)
      if (other != d && to_image->number[other] != 0)
        file.refuse("has images shifted along another axis (" + name + "); pairsum's boxes are straight");
    const double period = std::abs(to_image->number[d]);
    if (!has_box || !(period > 0 && std::isfinite(period))) continue;
    content.box_high[d] = content.box_low[d] + period;
    if (!(content.box_high[d] > content.box_low[d]))
      file.refuse("has a period of " + number_text(period) + " (" + name + "), which is nothing beside MapPosMin");
  }
}

/// Particles are numbered: fixed walls first, then moving walls, floating bodies, and fluid.
std::vector<particle_kind> kinds(const std::vector<double>& ids, bi4_items& file) {
  const double walls = number_or_0(file, "CaseNfixed") + number_or_0(file, "CaseNmoving");
  const double bodies = walls + number_or_0(file, "CaseNfloat");
  const auto floating = std::ranges::count_if(ids, [&](double id) { return id >= walls && id < bodies; });
  if (floating > 0)
    file.refuse("has " + std::to_string(floating) +
                " particles of floating bodies, which pairsum does not sum; --boundary-kind none takes all "
                "particles for fluid");
  std::vector<particle_kind> all(ids.size());
  std::ranges::transform(ids, all.begin(),
                         [&](double id) { return id < walls ? particle_kind::boundary : particle_kind::fluid; });
  return all;
}

file_content read(const std::string& path, const hints& told) {
  bi4_items file(path);
  if (!told.columns.empty()) file.refuse("names its columns itself; --column is for CSV");
  const auto first_of = [&](std::string_view name, std::string_view other) { return file.array(name) ? name : other; };
  const std::string_view position = first_of("Posd", "Pos"), id = first_of("Idpd", "Idp");
  if (!file.array(position) || file.array(position)->rows == 0)
    file.refuse("has no particles: no array Pos or Posd with rows, of those it has: " + join(file.array_names()));
  const std::size_t rows = file.array(position)->rows;
  const auto columns = [&](std::string_view name, std::size_t width) {
    if (file.array(name)->rows != rows)
      file.refuse("has " + std::to_string(file.array(name)->rows) + " rows in its array " + shown(name) +
                  ", should have " + std::to_string(rows) + " as " + std::string(position));
    auto all = file.columns(name);
    if (all.size() != width)
      file.refuse("has " + std::to_string(all.size()) + " numbers a row in its array " + shown(name) +
                  ", should have " + std::to_string(width));
    return all;
  };

  file_content content;
  content.format = "bi4";
  content.dialect = "dualsphysics";
  read_header(file, content);
  const std::vector<int> kept = content.dim == 2 ? std::vector{0, 2} : std::vector{0, 1, 2};
  read_domain(file, kept, content);
  const auto vectors = [&](std::string_view name, std::array<std::vector<double>, 3>& to) {
    auto all = columns(name, 3);
    for (const int d : kept) to[static_cast<std::size_t>(d)] = std::move(all[static_cast<std::size_t>(d)]);
  };
  vectors(position, content.x);
  if (file.array("Vel")) vectors("Vel", content.v);
  for (const auto& [name, to] :
       {std::pair{"Rhop", &content.rho}, std::pair{"Mass", &content.m}, std::pair{"Hvar", &content.h}})
    if (file.array(name)) *to = std::move(columns(name, 1)[0]);
  if (const auto rule = boundary_rule::of(told.boundary_kind); !rule) {
    if (file.array(id) && file.value("CaseNfixed")) content.kind = kinds(columns(id, 1)[0], file);
  } else if (!rule->none()) {
    if (!file.array(rule->column))
      file.refuse("has no array " + shown(rule->column) + " (--boundary-kind), but " + join(file.array_names()));
    content.others[rule->column] = std::move(columns(rule->column, 1)[0]);
  }
  return content;
}

}  // namespace

namespace formats_of {
file_format bi4() { return {"bi4", "binary files of DualSPHysics (.bi4)", recognises, read}; }
}  // namespace formats_of

}  // namespace pairsum::files
