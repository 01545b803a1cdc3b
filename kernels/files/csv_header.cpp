#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <system_error>

#include <pairsum/core/names.hpp>
#include <pairsum/files/csv_header.hpp>
#include <pairsum/files/csv_lines.hpp>
#include <pairsum/files/shown.hpp>

namespace pairsum::files {
namespace {

constexpr std::string_view positions =
    "@,pos#,position#,positions#,point#,points#,coord#,coords#,coordinate#,coordinates#,@coordinate";
constexpr std::string_view velocities = "v@,vel#,velocity#,velocities#,@velocity,~";

/// The name in small letters and digits, without its unit: "posx" of "Pos.x [m]". An axis in parentheses is no unit.
std::string plain(std::string_view name) {
  std::string text;
  for (std::size_t k = 0; k < name.size(); ++k) {
    const bool axis =
        name.size() > k + 2 && name[k + 2] == ')' && std::string_view("xyz012").find(name[k + 1]) != name.npos;
    if (!text.empty() && (name[k] == '[' || (name[k] == '(' && !axis))) break;
    const auto c = static_cast<unsigned char>(name[k]);
    if (std::isalnum(c)) text += static_cast<char>(std::tolower(c));
  }
  return text;
}

bool spells(std::string_view pattern, std::string_view word, int axis) {
  return std::ranges::equal(pattern, word, [&](char p, char c) {
    if (axis < 0) return p == c;
    const char letter = "xyz"[axis], digit = "012"[axis], of_velocity = "uvw"[axis];
    return p == '#' ? c == letter || c == digit : c == (p == '@' ? letter : p == '~' ? of_velocity : p);
  });
}

}  // namespace

const std::vector<csv_quantity>& csv_quantities() {
  static const std::vector<csv_quantity> all{
      {"x", positions, "m", 0},
      {"y", positions, "m", 1},
      {"z", positions, "m", 2},
      {"vx", velocities, "m/s", 0},
      {"vy", velocities, "m/s", 1},
      {"vz", velocities, "m/s", 2},
      {"rho", "rho,rhop,density,densities,dens", "kg/m^3,kg/m3"},
      {"m", "m,mass,masses", "kg"},
      {"h", "h,hsml,hvar,smoothinglength,smoothinglengths", "m"},
      {"kind", "type", ""},
  };
  return all;
}

std::optional<csv_header> csv_header::of(std::string_view line) {
  constexpr std::size_t most = 1000;
  csv_header header;
  for (const char separator : {'\t', ';'})
    if (line.find(separator) != line.npos) header.separator = separator;
  if (static_cast<std::size_t>(std::ranges::count(line, header.separator)) >= most) return {};
  std::vector<std::string_view> fields;
  if (!split_fields(line, header.separator, fields) || fields.size() < 2) return {};
  for (const std::string_view field : fields) {
    if (number_of(field)) return {};
    std::string name(field);
    for (std::size_t at = 0; (at = name.find("\"\"", at)) != name.npos; ++at) name.erase(at, 1);
    header.names.push_back(name);
  }
  return header;
}

std::optional<std::size_t> csv_header::column_named(std::string_view name) const {
  const auto exact = std::ranges::find(names, name);
  const auto found = exact != names.end() ? exact : std::ranges::find(names, plain(name), plain);
  if (found == names.end() || name.empty()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::size_t> csv_header::column(const csv_quantity& quantity, const hints& told) const {
  if (const auto named = told.columns.find(std::string(quantity.word)); named != told.columns.end())
    return column_named(named->second);
  if (quantity.word == "kind")
    if (const auto own = std::ranges::find(names, "Kind"); own != names.end())
      return static_cast<std::size_t>(own - names.begin());
  std::string_view spellings = quantity.spellings;
  while (!spellings.empty()) {
    const std::string_view one = spellings.substr(0, spellings.find(','));
    const auto found =
        std::ranges::find_if(names, [&](const std::string& name) { return spells(one, plain(name), quantity.axis); });
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    spellings.remove_prefix(std::min(one.size() + 1, spellings.size()));
  }
  return {};
}

bool csv_header::has_positions(const hints& told) const {
  const auto& all = csv_quantities();
  return column(all[0], told) && (column(all[1], told) || column(all[2], told));
}

std::string csv_header::listed() const {
  constexpr std::size_t most = 40;
  std::string text;
  for (std::size_t k = 0; k < names.size() && k < most; ++k)
    if (!names[k].empty()) text += (text.empty() ? "" : ", ") + shown(names[k]);
  return text + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
}

std::string_view other_unit(std::string_view name, const csv_quantity& quantity) {
  const std::size_t open = name.find_last_of("[(");
  if (open == name.npos || open == 0 || !(name.ends_with(']') || name.ends_with(')'))) return {};
  const std::string_view unit = name.substr(open + 1, name.size() - open - 2);
  const bool axis = unit.size() == 1 && std::string_view("xyz012-").find(unit[0]) != unit.npos;
  return unit.empty() || axis || quantity.units.empty() || is_in(quantity.units, unit) ? std::string_view{} : unit;
}

bool names_time(std::string_view name) {
  const std::string word = plain(name);
  return word == "time" || word == "timestep";
}

std::string_view without_comment_sign(std::string_view line) {
  line = trimmed(line);
  while (!line.empty() && std::string_view("#%!/").find(line.front()) != line.npos) line.remove_prefix(1);
  return line;
}

std::optional<double> number_of(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0;
  const auto end = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end.ec == std::errc{} && end.ptr == field.data() + field.size() && !field.empty()) return value;
  // Too small for a double: 0.
  const bool all = end.ptr == field.data() + field.size();
  if (end.ec == std::errc::result_out_of_range && all &&
      (field.find("e-") != field.npos || field.find("E-") != field.npos))
    return 0;
  constexpr std::size_t longest = 64;
  const std::size_t comma = field.find(',');
  if (comma == field.npos || field.size() > longest) return {};
  std::string with_point(field);
  with_point[comma] = '.';
  return with_point.find(',') == with_point.npos ? number_of(with_point) : std::nullopt;
}

}  // namespace pairsum::files
