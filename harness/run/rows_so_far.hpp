#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/plan/study.hpp"
#include "harness/rows/reader.hpp"

namespace pairsum::harness {

/// What a rows file holds of a plan since the plan was last carried out to its end. Each row is looked at once, while
/// the file grows.
class rows_so_far {
 public:
  /// `path` may not exist yet; a last line that was cut does not count. Throws like rows_reader for any other fault.
  rows_so_far(const std::filesystem::path& path, const study_plan& plan);

  /// Takes in what was appended since; throws like rows_reader.
  void read_on() { take_in(cut_line::refuse); }
  /// The same, and takes a cut last line away. Returns its number of bytes.
  std::size_t drop_cut_line();

  /// Finished rounds of the plan, and of a part of it.
  std::size_t finished() const;
  const std::vector<round_row>& rounds(const std::string& part) const;
  /// The next round's number, and the next replicate of a part.
  int next_round() const { return last_round_ + 1; }
  int next_replicate(const std::string& part) const;
  /// Are there finished rounds since the last end?
  bool open() const { return finished() > 0; }
  /// Was the plan begun and not carried out to its end? A file in which no round was finished may be of any plan.
  bool unended() const {
    return open() || (!rows().environments.empty() && rows().rounds.empty() && rows().ends.empty());
  }

  /// The largest half-width of the intervals for the medians of the summation times over the rounds of a part, as a
  /// share of the median; empty while there are too few rounds for an interval.
  std::optional<double> half_width(const std::string& part) const;

  /// Has a part its rounds, or enough of them for intervals as narrow as wanted?
  bool done(const part_plan& part) const;
  /// Where a part stands, for people: "a round 7/30, +-2.3 % (goal 2.0)".
  std::string standing(const part_plan& part) const;

  const rows_file& rows() const { return reader_.rows(); }
  const known_names& known() const { return reader_.known(); }
  /// How many bytes of the file are read.
  std::size_t bytes() const { return reader_.bytes(); }
  /// All finished rounds of the plan, those before the last end included, and their samples.
  const std::vector<round_row>& all_rounds() const { return all_rounds_; }
  std::vector<sample> samples() const;
  /// How many rounds of the study are void.
  std::size_t voids() const { return voided_.size(); }
  /// How many samples a round of the study has, finished or not.
  std::uint64_t samples_of(int round) const;

 private:
  struct mean {
    double sum = 0;
    int n = 0;
  };
  /// What a round says: how many samples it has, and the mean summation time by point and environment.
  struct round_means {
    std::uint64_t samples = 0;
    std::map<std::pair<std::size_t, std::string>, mean> times;
  };

  void take_in(cut_line last_line);
  void take_in(const sample& s);
  void take_in(const round_row& r);
  /// What came before an end of the plan belongs to a pass over it that is done.
  void take_in_ends(std::size_t rounds_before);

  rows_reader reader_;
  std::string study_, plan_;
  struct {
    std::size_t samples = 0, paces = 0, voids = 0, rounds = 0, ends = 0;
  } seen_;  ///< rows taken in
  std::vector<point> points_;
  std::set<int> voided_;
  std::map<int, round_means> means_;
  std::map<std::string, std::vector<round_row>> rounds_;
  std::vector<round_row> all_rounds_;
  std::map<std::string, int> replicates_;  ///< the largest so far, those before the last end included
  int last_round_ = 0;
};

}  // namespace pairsum::harness
