#pragma once
#include <string>
#include <vector>

#include "harness/run/ranking.hpp"

namespace pairsum::harness {

/// The levels, beside the backend, by which the points of a run differ, and those that they have in common.
class level_columns {
 public:
  explicit level_columns(const std::vector<ranking>& all);

  /// Names of the levels that differ.
  const std::vector<std::string>& names() const { return names_; }
  /// The words of a point for these.
  std::vector<std::string> words_of(const ranked& r) const;
  /// The words that all points share: "double, hashed_grid, M 6, threads 2, 6 rounds".
  const std::string& common() const { return common_; }
  /// A point in words: "tiles_omp M=7 threads=2 mixed".
  std::string name_of(const ranked& r) const;

 private:
  std::vector<std::size_t> shown_;  ///< which of the levels differ
  std::vector<std::string> names_;
  std::string common_;
};

}  // namespace pairsum::harness
