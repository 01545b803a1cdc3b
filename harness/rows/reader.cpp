#include "harness/rows/reader.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "core/error.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

std::string read_text(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) throw error(path.string() + ": is a folder, should be a rows file");
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw error(path.string() + ": is no regular file, should be a rows file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw error(path.string() + ": cannot be read: " + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Adds the rows of one text line by line, and knows where it is for the messages.
class line_parser {
 public:
  line_parser(const std::string& text, rows_file& rows) : text_(text), rows_(rows) {}

  void parse(cut_line last_line) {
    for (std::size_t begin = 0; begin < text_.size();) {
      ++number_;
      const std::size_t newline = text_.find('\n', begin);
      const bool whole = newline != std::string::npos;
      const std::size_t end = whole ? newline : text_.size();
      const bool last = !whole || newline + 1 == text_.size();
      if (parse_line(text_.substr(begin, end - begin), whole, last, last_line)) break;
      begin = end + 1;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw error(rows_.path.string() + ":" + std::to_string(number_) + ": " + what);
  }

  [[noreturn]] void foreign(const std::string& why) const {
    fail("this is no rows file: its first line should be a JSON object with \"schema\":\"" + std::string(row_schema) +
         "\", " + why);
  }

  /// Returns true if the line was cut and dropped.
  bool parse_line(const std::string& line, bool whole, bool last, cut_line last_line) {
    json j;
    bool parsed = true;
    std::string why;
    try {
      j = json::parse(line);
    } catch (const json::parse_error&) {
      parsed = false;
      why = "it is no whole JSON value";
    } catch (const json::exception&) {
      parsed = false;
      why = "it holds a number out of range";
    }
    const bool looks_cut = !whole || (last && !parsed);
    if (number_ == 1 && (line.empty() || line[0] != '{')) foreign("is not");
    if (number_ == 1 && parsed && !j.contains("schema")) foreign("has none");
    if (number_ == 1 && !parsed && !(cut_row(line) && (last || line.size() > 2))) foreign("is not");
    if (looks_cut) {
      if (last_line == cut_line::drop) return rows_.last_line_cut = true;
      fail("the last line is cut (" + std::string(whole ? why : "no newline at its end") + "); remove it to keep the " +
           std::to_string(rows_.size()) + " whole rows before it");
    }
    if (!parsed) fail(why);
    try {
      add(parse_row(j));
    } catch (const error& e) {
      fail(e.what());
    }
    return false;
  }

  /// Whether a line that does not parse can be the beginning of a row, by the keys that come first.
  static bool cut_row(const std::string& line) {
    for (const std::string begin : {"{\"barrier_wait_s\":", "{\"binding\":", "{\"kind\":", "{\"schema\":"})
      if (line.compare(0, begin.size(), begin, 0, line.size()) == 0) return true;
    return false;
  }

  void add(row&& r) {
    if (auto* e = std::get_if<environment_row>(&r)) {
      known_.insert(e->environment);
      rows_.environments.push_back(std::move(*e));
    } else if (auto* v = std::get_if<void_row>(&r)) {
      rows_.voids.push_back(std::move(*v));
    } else {
      sample& s = std::get<sample>(r);
      if (known_.count(s.environment) == 0)
        throw error("key \"environment\" should name an environment row before it, is \"" + s.environment + "\"");
      rows_.samples.push_back(std::move(s));
    }
  }

  const std::string& text_;
  rows_file& rows_;
  std::size_t number_ = 0;
  std::set<std::string> known_;
};

}  // namespace

std::vector<sample> rows_file::valid_samples() const {
  std::set<std::pair<std::string, int>> voided;
  for (const void_row& v : voids) voided.emplace(v.study, v.round);
  std::vector<sample> valid;
  for (const sample& s : samples)
    if (voided.count({s.study, s.round}) == 0) valid.push_back(s);
  return valid;
}

rows_file read_rows(const std::filesystem::path& path, cut_line last_line) {
  rows_file rows;
  rows.path = path;
  const std::string text = read_text(path);
  if (text.empty()) throw error(path.string() + ": is empty, should hold rows of " + row_schema);
  line_parser(text, rows).parse(last_line);
  return rows;
}

}  // namespace pairsum::harness
