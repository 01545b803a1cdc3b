#pragma once

#include <cstddef>
#include <filesystem>
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
  std::vector<void_row> voids;
  std::vector<peak_row> peaks;
  std::vector<pace_row> paces;
  std::vector<round_row> rounds;
  std::vector<end_row> ends;
  std::vector<std::size_t> rounds_before_end;  ///< of each end row: how many round rows stand before it
  bool last_line_cut = false;                  ///< a cut last line was dropped

  std::size_t size() const {
    return samples.size() + environments.size() + voids.size() + peaks.size() + paces.size() + rounds.size() +
           ends.size();
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

/// What to do with a last line that was cut while it was written.
enum class cut_line { refuse, drop };

/// Reads a rows file strictly. Throws pairsum::error with one line `FILE:LINE: what` for a file
/// that cannot be opened, is empty, is no rows file, has a wrong row, a sample before its
/// environment row, or a cut last line (unless it is to be dropped).
rows_file read_rows(const std::filesystem::path& path, cut_line last_line = cut_line::refuse);

}  // namespace pairsum::harness
