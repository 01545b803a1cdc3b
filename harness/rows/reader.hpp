#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// The rows of one file, in file order within each kind.
struct rows_file {
  std::filesystem::path path;
  std::vector<sample> samples;
  std::vector<environment_row> environments;
  std::vector<backend_row> backends;  ///< none of the former schema
  std::vector<void_row> voids;
  std::vector<peak_row> peaks;
  std::vector<pace_row> paces;
  std::vector<round_row> rounds;
  std::vector<end_row> ends;
  std::vector<particles_row> particles;
  std::vector<std::size_t> rounds_before_end;  ///< of each end row: how many round rows stand before it
  bool last_line_cut = false;                  ///< a cut last line was dropped
  bool former_schema = false;                  ///< a row is of the former schema

  std::size_t size() const {
    return samples.size() + environments.size() + backends.size() + voids.size() + peaks.size() + paces.size() +
           rounds.size() + ends.size() + particles.size();
  }
  /// The samples of finished rounds: those that a round row closes and no void row names.
  std::vector<sample> valid_samples() const;
  /// The paces of finished rounds.
  std::vector<pace_row> valid_paces() const;
  /// The round rows that no void row names.
  std::vector<round_row> finished_rounds() const;
  /// Rounds that have samples or paces but no round row and no void row, as (study, round).
  std::vector<std::pair<std::string, int>> unfinished_rounds() const;
};

/// Names that later rows of a file may refer to.
struct known_names {
  std::set<std::string> environments;
  std::set<std::pair<std::string, std::string>> backends;  ///< (environment, backend)
  std::set<std::string> particles;
};

/// What to do with a truncated last line.
enum class cut_line { refuse, drop };

/// Reads a rows file strictly, each row once, while it grows.
class rows_reader {
 public:
  explicit rows_reader(std::filesystem::path path);

  /// Reads the rows that were appended since the last call. Throws pairsum::error with one line `FILE:LINE: what` for a
  /// file that cannot be opened, is empty, is no rows file, has a wrong row, a sample before its environment row or its
  /// backend row (the former schema has no backend rows), or a cut last line (unless it is to be dropped).
  void read_on(cut_line last_line = cut_line::refuse);
  /// Reads on, then removes a truncated last line, so that rows can be appended. Returns the number of bytes removed; 0
  /// if there is no file or nothing to remove.
  std::size_t drop_cut_line();

  const rows_file& rows() const { return rows_; }
  const known_names& known() const { return known_; }
  /// How many bytes of the file are read.
  std::size_t bytes() const { return offset_; }
  /// Is there a file with something in it?
  bool has_rows() const;

 private:
  class parser;

  rows_file rows_;
  known_names known_;
  std::size_t offset_ = 0, lines_ = 0;  ///< read so far
  std::map<std::pair<std::string, int>, std::uint64_t> samples_;
  std::set<std::pair<std::string, int>> closed_;
};

/// Reads a rows file at once, as rows_reader does.
rows_file read_rows(const std::filesystem::path& path, cut_line last_line = cut_line::refuse);

/// Bytes of rows files that this process has read so far: what reading costs, without a clock.
std::uint64_t bytes_of_rows_read();

}  // namespace pairsum::harness
