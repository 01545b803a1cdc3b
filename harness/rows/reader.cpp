#include "harness/rows/reader.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include <pairsum/core/error.hpp>
#include "harness/rows/json_file.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

std::atomic<std::uint64_t> bytes_read = 0;

constexpr std::size_t longest_line = std::size_t{16} << 20;

/// A file behind its first `offset` bytes.
std::ifstream opened(const std::filesystem::path& path, std::size_t offset) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) throw error(path.string() + ": is a folder, should be a rows file");
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw error(path.string() + ": is no regular file, should be a rows file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw error(path.string() + ": cannot be read: " + std::strerror(errno));
  file.seekg(static_cast<std::streamoff>(offset));
  return file;
}

/// Reads up to a megabyte more; false at the end of the file.
bool append(std::ifstream& file, std::string& text) {
  const std::size_t before = text.size(), more = std::size_t{1} << 20;
  text.resize(before + more);
  file.read(text.data() + before, static_cast<std::streamsize>(more));
  const auto found = static_cast<std::size_t>(file.gcount());
  text.resize(before + found);
  bytes_read += found;
  return found == more;
}

}  // namespace

/// Adds the rows of what was appended line by line, and knows where it is for the messages.
class rows_reader::parser {
 public:
  parser(rows_reader& to, cut_line last_line) : to_(to), rows_(to.rows_), last_line_(last_line) {
    rows_.last_line_cut = false;
  }

  /// Takes in the lines of a text but for the last, and that, too, if the file ends with it. Returns how many bytes
  /// these are.
  std::size_t parse(const std::string& text, bool file_ends) {
    if (to_.lines_ == 0) check_beginning(text);
    std::size_t begin = 0;
    while (begin < text.size()) {
      number_ = to_.lines_ + 1;
      const std::size_t newline = text.find('\n', begin);
      const bool whole = newline != std::string::npos;
      const std::size_t end = whole ? newline : text.size();
      const bool last = !whole || newline + 1 == text.size();
      if (end - begin > longest_line) fail("the line has more than 16 MB");
      if (last && !file_ends) break;
      if (parse_line(text.substr(begin, end - begin), whole, last)) break;
      ++to_.lines_;
      to_.offset_ += end + 1 - begin;
      begin = end + 1;
    }
    return begin;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw error(rows_.path.string() + ":" + std::to_string(number_) + ": " + what);
  }

  [[noreturn]] void foreign(const std::string& why) const {
    fail("this is no rows file: its first line should be a JSON object with \"schema\":\"" + std::string(row_schema) +
         "\", " + why);
  }

  /// Before a first line that may be long is read to its end.
  void check_beginning(std::string_view text) {
    number_ = 1;
    check_encoding(text.substr(0, 4), rows_.path.string());
    if (!text.empty() && !without_mark(text).starts_with('{')) foreign("is not");
  }

  /// Returns true if the line was cut and dropped.
  bool parse_line(std::string_view line, bool whole, bool last) {
    if (number_ == 1) line = without_mark(line);
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
    if (number_ == 1 && parsed && !j.contains("schema")) foreign("has none");
    if (number_ == 1 && !parsed && !(cut_row(line) && (last || line.size() > 2))) foreign("is not");
    if (looks_cut) {
      if (last_line_ == cut_line::drop) return rows_.last_line_cut = true;
      fail("the last line is cut (" + std::string(whole ? why : "no newline at its end") + "); remove it to keep the " +
           std::to_string(rows_.size()) + " whole rows before it");
    }
    if (!parsed) fail(why);
    if (const auto twice = doubled_key(line, j)) fail(*twice);
    try {
      row r = parse_row(j);
      former_ = j.at("schema") == former_row_schema;
      rows_.former_schema = rows_.former_schema || former_;
      std::visit([this](auto& v) { keep(std::move(v)); }, r);
    } catch (const error& e) {
      fail(e.what());
    }
    return false;
  }

  /// Whether a line that does not parse can be the beginning of a row, by the keys that come first.
  static bool cut_row(std::string_view line) {
    for (const std::string begin : {"{\"bandwidth_bytes_per_s\":", "{\"barrier_wait_s\":", "{\"binding\":",
                                    "{\"elapsed_s\":", "{\"environment\":", "{\"kind\":", "{\"schema\":"})
      if (line.compare(0, begin.size(), begin, 0, line.size()) == 0) return true;
    return false;
  }

  void known(const std::string& environment) const {
    if (!to_.known_.environments.contains(environment))
      throw error("key \"environment\" should name an environment row before it, is \"" + environment + "\"");
  }

  void keep(environment_row&& e) {
    to_.known_.environments.insert(e.environment);
    rows_.environments.push_back(std::move(e));
  }
  void keep(backend_row&& b) {
    known(b.environment);
    to_.known_.backends.emplace(b.environment, b.name);
    rows_.backends.push_back(std::move(b));
  }
  void keep(particles_row&& p) {
    to_.known_.particles.insert(p.particles);
    rows_.particles.push_back(std::move(p));
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
    if (to_.closed_.contains({study, round}))
      throw error("key \"round\" names round " + std::to_string(round) + ", which a round row before it has closed");
  }
  void keep(pace_row&& p) {
    known(p.environment);
    still_open(p.study, p.round);
    rows_.paces.push_back(std::move(p));
  }
  void keep(sample&& s) {
    known(s.environment);
    if (!former_ && !to_.known_.backends.contains({s.environment, s.point.backend}))
      throw error("key \"point.backend\" should name a backend row of its environment before it, is \"" +
                  s.point.backend + "\"");
    if (!s.point.particles.empty() && !to_.known_.particles.contains(s.point.particles))
      throw error("key \"point.particles\" should name a particles row before it, is \"" + s.point.particles + "\"");
    still_open(s.study, s.round);
    ++to_.samples_[{s.study, s.round}];
    rows_.samples.push_back(std::move(s));
  }
  void keep(round_row&& r) {
    known(r.environment);
    const std::uint64_t found = to_.samples_[{r.study, r.round}];
    if (!to_.closed_.emplace(r.study, r.round).second)
      throw error("key \"round\" names round " + std::to_string(r.round) + ", which is closed already");
    if (found != r.rows)
      throw error("key \"rows\" should be the number of samples of the round, " + std::to_string(found) + ", is " +
                  std::to_string(r.rows));
    rows_.rounds.push_back(std::move(r));
  }

  rows_reader& to_;
  rows_file& rows_;
  cut_line last_line_;
  std::size_t number_ = 0;
  bool former_ = false;
};

namespace {

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

rows_reader::rows_reader(std::filesystem::path path) { rows_.path = std::move(path); }

bool rows_reader::has_rows() const {
  std::error_code code;
  if (!std::filesystem::exists(rows_.path, code)) return false;
  return !std::filesystem::is_regular_file(rows_.path, code) || std::filesystem::file_size(rows_.path, code) > 0;
}

void rows_reader::read_on(cut_line last_line) {
  std::ifstream file = opened(rows_.path, offset_);
  parser lines(*this, last_line);
  std::string text;
  for (bool more = true; more;) {
    more = append(file, text);
    if (text.empty() && offset_ == 0)
      throw error(rows_.path.string() + ": is empty, should hold rows of " + row_schema);
    text.erase(0, lines.parse(text, !more));
  }
}

std::size_t rows_reader::drop_cut_line() {
  if (!has_rows()) return 0;
  read_on(cut_line::drop);
  if (!rows_.last_line_cut) return 0;
  std::error_code code;
  const auto size = std::filesystem::file_size(rows_.path, code);
  if (!code) std::filesystem::resize_file(rows_.path, offset_, code);
  if (code) throw error("cannot write rows to " + rows_.path.string() + ": " + code.message());
  rows_.last_line_cut = false;
  return static_cast<std::size_t>(size) - offset_;
}

rows_file read_rows(const std::filesystem::path& path, cut_line last_line) {
  rows_reader reader(path);
  reader.read_on(last_line);
  return reader.rows();
}

std::uint64_t bytes_of_rows_read() { return bytes_read; }

}  // namespace pairsum::harness
