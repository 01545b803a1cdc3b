#include "harness/rows/reader.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include <pairsum/core/error.hpp>

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
    for (const std::string begin : {"{\"bandwidth_bytes_per_s\":", "{\"barrier_wait_s\":", "{\"binding\":",
                                    "{\"elapsed_s\":", "{\"environment\":", "{\"kind\":", "{\"schema\":"})
      if (line.compare(0, begin.size(), begin, 0, line.size()) == 0) return true;
    return false;
  }

  void known(const std::string& environment) const {
    if (known_.count(environment) == 0)
      throw error("key \"environment\" should name an environment row before it, is \"" + environment + "\"");
  }

  void add(row&& r) {
    std::visit([this](auto& v) { keep(std::move(v)); }, r);
  }
  void keep(environment_row&& e) {
    known_.insert(e.environment);
    rows_.environments.push_back(std::move(e));
  }
  void keep(void_row&& v) { rows_.voids.push_back(std::move(v)); }
  void keep(end_row&& e) {
    rows_.ends.push_back(std::move(e));
    rows_.rounds_before_end.push_back(rows_.rounds.size());
  }
  void keep(peak_row&& p) {
    known(p.environment);
    rows_.peaks.push_back(std::move(p));
  }
  void still_open(const std::string& study, int round) const {
    if (closed_.count({study, round}) != 0)
      throw error("key \"round\" names round " + std::to_string(round) + ", which a round row before it has closed");
  }
  void keep(pace_row&& p) {
    known(p.environment);
    still_open(p.study, p.round);
    rows_.paces.push_back(std::move(p));
  }
  void keep(sample&& s) {
    known(s.environment);
    still_open(s.study, s.round);
    ++samples_[{s.study, s.round}];
    rows_.samples.push_back(std::move(s));
  }
  void keep(round_row&& r) {
    known(r.environment);
    const std::uint64_t found = samples_[{r.study, r.round}];
    if (!closed_.emplace(r.study, r.round).second)
      throw error("key \"round\" names round " + std::to_string(r.round) + ", which is closed already");
    if (found != r.rows)
      throw error("key \"rows\" should be the number of samples of the round, " + std::to_string(found) + ", is " +
                  std::to_string(r.rows));
    rows_.rounds.push_back(std::move(r));
  }

  const std::string& text_;
  rows_file& rows_;
  std::size_t number_ = 0;
  std::set<std::string> known_;
  std::map<std::pair<std::string, int>, std::uint64_t> samples_;
  std::set<std::pair<std::string, int>> closed_;
};

using round_set = std::set<std::pair<std::string, int>>;

round_set voided_in(const rows_file& rows) {
  round_set voided;
  for (const void_row& v : rows.voids) voided.emplace(v.study, v.round);
  return voided;
}

template <class Row>
std::vector<Row> of_finished_rounds(const rows_file& file, const std::vector<Row>& rows) {
  round_set finished;
  for (const round_row& r : file.finished_rounds()) finished.emplace(r.study, r.round);
  std::vector<Row> found;
  for (const Row& r : rows)
    if (finished.count({r.study, r.round}) != 0) found.push_back(r);
  return found;
}

}  // namespace

std::vector<round_row> rows_file::finished_rounds() const {
  const round_set voided = voided_in(*this);
  std::vector<round_row> finished;
  for (const round_row& r : rounds)
    if (voided.count({r.study, r.round}) == 0) finished.push_back(r);
  return finished;
}

std::vector<sample> rows_file::valid_samples() const { return of_finished_rounds(*this, samples); }
std::vector<pace_row> rows_file::valid_paces() const { return of_finished_rounds(*this, paces); }

std::vector<std::pair<std::string, int>> rows_file::unfinished_rounds() const {
  round_set settled = voided_in(*this);
  for (const round_row& r : rounds) settled.emplace(r.study, r.round);
  std::vector<std::pair<std::string, int>> open;
  const auto look = [&](const auto& rows) {
    for (const auto& r : rows)
      if (settled.emplace(r.study, r.round).second) open.emplace_back(r.study, r.round);
  };
  look(samples);
  look(paces);
  return open;
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
