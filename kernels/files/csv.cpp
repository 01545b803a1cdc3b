// Text files with a line per particle: tables, what PartVTK of DualSPHysics writes, and what ParaView exports.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <pairsum/core/names.hpp>
#include <pairsum/files/csv_header.hpp>
#include <pairsum/files/csv_lines.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/shown.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

constexpr int longest_preamble = 100;  // lines

bool recognises(std::span<const std::byte> head, std::string_view path) {
  std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  for (const std::string_view ending : {".csv", ".tsv"})
    if (ends_in(path, ending)) return true;
  if (text.find('\0') != text.npos) return false;
  for (; !text.empty(); text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1))
    if (const auto header = csv_header::of(without_comment_sign(text.substr(0, text.find_first_of("\r\n"))));
        header && header->has_positions({}))
      return true;
  return false;
}

/// What a preamble says of the time, in a line of names and one of numbers, or in one of both.
void read_time(std::string_view line, const std::vector<std::string>& names_before, char separator,
               file_content& content) {
  const auto take = [&](std::string_view name, std::string_view field) {
    const auto number = number_of(field);
    if (names_time(name) && number && std::isfinite(*number)) content.time = number;
  };
  std::vector<std::string_view> fields;
  if (split_fields(line, separator, fields))
    for (std::size_t k = 0; k < std::min(fields.size(), names_before.size()); ++k) take(names_before[k], fields[k]);
  const std::string_view words = without_comment_sign(line);
  const std::size_t mark = words.find_first_of(":=;,\t");
  if (mark == words.npos) return;
  const std::string_view rest = trimmed(words.substr(mark + 1));
  take(words.substr(0, mark), trimmed(rest.substr(0, rest.find_first_of(words[mark] == ',' ? ",;\t" : ";\t"))));
}

/// Goes to the line that names the columns, and gives it.
csv_header find_header(csv_lines& lines, const std::string& path, const hints& told, file_content& content) {
  csv_header most, before;
  std::uint64_t most_at = 0;
  std::string_view line;
  for (int k = 0; k < longest_preamble && lines.next(line); ++k) {
    if (line.find('\r') != line.npos) lines.refuse("lines end in CR alone, should end in LF or CR LF");
    const auto header = csv_header::of(without_comment_sign(line));
    if (header && header->has_positions(told)) return *header;
    read_time(line, before.names, before.separator, content);
    before = header.value_or(csv_header{});
    if (before.names.size() > most.names.size()) {
      most = before;
      most_at = lines.number();
    }
  }
  if (most.names.empty())
    throw error(path +
                " names no columns; a line above the numbers should, for example x,y,z,vx,vy,vz,rho, with commas, "
                "semicolons or tabs");
  for (const auto& [quantity, name] : told.columns)
    if (!most.column_named(name))
      throw error((path + " has no column ").append(shown(name)) + " (--column " + quantity + "=...); line " +
                  std::to_string(most_at) + " has " + most.listed());
  throw error(path + " has no columns that are known as x and as y or z; line " + std::to_string(most_at) + " has " +
              most.listed() + "; say which, for example --column x=NAME");
}

/// A column that is read.
struct column {
  const csv_quantity* quantity;  ///< null: the one hints take for the kind
  std::size_t at;
  std::string name;
  std::vector<double> numbers;
  bool empty = false;     ///< in all lines
  bool own_kind = false;  ///< pairsum's Kind, which has other numbers than Type

  bool is(std::string_view word) const { return quantity && quantity->word == word; }
  bool must() const { return !quantity || is("x") || is("y") || is("z"); }
};

std::vector<column> chosen_columns(const csv_header& header, const hints& told, const csv_lines& lines,
                                   file_content& content) {
  std::vector<std::string> words;
  for (const csv_quantity& q : csv_quantities()) words.emplace_back(q.word);
  const auto rule = boundary_rule::of(told.boundary_kind);
  std::vector<column> chosen;
  const auto choose = [&](const csv_quantity* q, std::optional<std::size_t> at, const std::string& name,
                          const std::string& option) {
    if (!at) lines.refuse("there is no column " + shown(name) + " (" + option + "), but " + header.listed());
    if (std::ranges::count(header.names, header.names[*at]) > 1)
      lines.refuse("there are two columns " + shown(header.names[*at]));
    chosen.push_back({q, *at, shown(header.names[*at]), {}});
    chosen.back().own_kind = q != nullptr && header.names[*at] == "Kind";
  };
  for (const auto& [word, name] : told.columns) check_word("quantity of --column", word, words);
  for (const csv_quantity& q : csv_quantities()) {
    const auto named = told.columns.find(std::string(q.word));
    const auto at = header.column(q, told);
    if (named != told.columns.end())
      choose(&q, at, named->second, "--column " + named->first);
    else if (at && (q.word != "kind" || !rule))
      choose(&q, at, "", "");
    if (const std::string_view unit = at ? other_unit(header.names[*at], q) : ""; !unit.empty())
      content.facts.push_back(
          {"unit of " + std::string(q.word), std::string(unit), origin::read, shown(header.names[*at])});
  }
  if (rule && !rule->none()) choose(nullptr, header.column_named(rule->column), rule->column, "--boundary-kind");
  return chosen;
}

/// pairsum's Kind, or DualSPHysics' Type.
particle_kind kind_of(double type, const column& c, const csv_lines& lines) {
  if (c.own_kind) {
    if (type == 0 || type == 1) return type == 0 ? particle_kind::fluid : particle_kind::boundary;
    lines.refuse(c.name + " is " + number_text(type) +
                 ", should be 0 (fluid) or 1 (boundary); for other numbers say --boundary-kind \"Kind=2\", or none");
  }
  constexpr int fixed = 0, moving = 1, floating = 2, fluid = 3;
  if (type == fixed || type == moving) return particle_kind::boundary;
  if (type == fluid) return particle_kind::fluid;
  if (type == floating)
    lines.refuse(
        c.name +
        " is 2, a floating body, which pairsum does not sum; --boundary-kind none takes all particles for fluid");
  lines.refuse(c.name + " is " + number_text(type) +
               ", should be 0 or 1 (wall) or 3 (fluid); for other numbers say --boundary-kind \"NAME=0,1\", "
               "or none");
}

void read_lines(csv_lines& lines, const csv_header& header, std::vector<column>& columns, file_content& content) {
  std::size_t names = header.names.size();
  while (header.names[names - 1].empty()) --names;
  const std::uint64_t most = lines.count_left();
  for (column& c : columns)
    if (!c.is("kind")) c.numbers.reserve(most);
  bool comma = false, point = false, first = true;
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (!split_fields(line, header.separator, fields)) lines.refuse("a quote is not closed, or something follows it");
    const bool all_empty_behind =
        std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(fields.size(), names)), fields.end(),
                    [](auto f) { return f.empty(); });
    if (fields.size() < names || !all_empty_behind)
      lines.refuse("has " + std::to_string(fields.size()) + " fields, should have " + std::to_string(names) +
                   " as the line of names");
    for (column& c : columns) {
      const std::string_view field = fields[c.at];
      if (first) c.empty = field.empty() && !c.must();
      if (c.empty && field.empty()) continue;
      if (c.empty || field.empty())
        lines.refuse(c.name + (c.empty ? " has a number here, and none in lines above"
                                       : " is empty; it should be a number in all lines or in none"));
      const auto number = number_of(field);
      if (!number || !std::isfinite(*number)) lines.refuse(c.name + " is " + shown(field) + ", should be a number");
      comma = comma || field.find(',') != field.npos;
      point = point || field.find('.') != field.npos;
      if (comma && point)
        lines.refuse(c.name + " is " + shown(field) + ": numbers here have decimal points, others decimal commas");
      if (c.is("kind"))
        content.kind.push_back(kind_of(*number, c, lines));
      else
        c.numbers.push_back(*number);
    }
    first = false;
  }
  if (first) lines.refuse("no particles: no line of numbers below that of names");
}

file_content read(const std::string& path, const hints& told) {
  csv_lines lines(path);
  file_content content;
  const csv_header header = find_header(lines, path, told, content);
  std::vector<column> columns = chosen_columns(header, told, lines, content);
  content.format = "csv";
  content.dialect = header.column_named("Idp") || header.column_named("Rhop") ? "dualsphysics" : "table";
  // Without one of the axes they are 2D, and a velocity along it does not count.
  const auto has = [&](std::string_view word) {
    return std::ranges::any_of(columns, [&](const column& c) { return c.is(word); });
  };
  if (!has("y") || !has("z")) {
    content.dim = 2;
    const std::string_view v = has("y") ? "vz" : "vy";
    std::erase_if(columns, [&](const column& c) { return c.is(v); });
  }
  const auto speeds =
      std::ranges::count_if(columns, [](const column& c) { return c.quantity && c.quantity->units == "m/s"; });
  const int dim = content.dim.value_or(3);
  if (speeds != 0 && speeds != dim)
    lines.refuse("has " + std::to_string(speeds) + " of " + std::to_string(dim) + " velocities among " +
                 header.listed() + "; --column vx=NAME says which others");
  read_lines(lines, header, columns, content);

  std::ptrdiff_t velocities = 0;
  for (column& c : columns) {
    const auto axis = static_cast<std::size_t>(c.quantity ? std::max(c.quantity->axis, 0) : 0);
    if (!c.quantity)
      content.others[boundary_rule::of(told.boundary_kind)->column] = std::move(c.numbers);
    else if (c.must())
      content.x[axis] = std::move(c.numbers);
    else if (c.quantity->axis >= 0) {
      velocities += !c.empty;
      content.v[axis] = std::move(c.numbers);
    } else if (c.is("rho"))
      content.rho = std::move(c.numbers);
    else if (c.is("m"))
      content.m = std::move(c.numbers);
    else if (c.is("h"))
      content.h = std::move(c.numbers);
  }
  if (velocities != 0 && velocities != speeds) throw error(path + " has velocities of which some are empty");
  return content;
}

}  // namespace

namespace formats_of {
file_format csv() {
  return {"csv", "text with a line per particle and names of columns above (.csv)", recognises, read};
}
}  // namespace formats_of

}  // namespace pairsum::files
