#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/plan/study.hpp"
#include "harness/rows/reader.hpp"

namespace pairsum::harness {

/// What a rows file holds of a plan since the plan was last carried out to its end.
class rows_so_far {
 public:
  /// `path` may not exist yet; a last line that was cut does not count. Throws like read_rows for any other fault.
  rows_so_far(const std::filesystem::path& path, const study_plan& plan);

  /// Finished rounds of the plan, and of a part of it.
  std::size_t finished() const;
  const std::vector<round_row>& rounds(const std::string& part) const;
  /// The next round's number, and the next replicate of a part.
  int next_round() const { return last_round_ + 1; }
  int next_replicate(const std::string& part) const;
  /// Are there finished rounds since the last end?
  bool open() const { return !rounds_.empty(); }
  /// Was the plan begun and not carried out to its end? A file in which no round was finished may be of any plan.
  bool unended() const { return open() || (!rows_.environments.empty() && rows_.rounds.empty() && rows_.ends.empty()); }

  /// The largest half-width of the intervals for the medians of the summation times over the rounds of a part, as a
  /// share of the median; empty while there are too few rounds for an interval.
  std::optional<double> half_width(const std::string& part) const;

  const rows_file& rows() const { return rows_; }
  /// Samples of the finished rounds since the last end.
  std::vector<sample> samples() const;

 private:
  rows_file rows_;
  std::string study_;
  std::map<std::string, std::vector<round_row>> rounds_;
  std::map<std::string, int> replicates_;  ///< the largest so far, those before the last end included
  int last_round_ = 0;
};

}  // namespace pairsum::harness
