#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/rows/reader.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// One round of a file: points measured in the same round are paired.
struct round_key {
  std::size_t file = 0;
  int round = 1;
  auto operator<=>(const round_key&) const = default;
};

/// Where the machine's own pace was measured in a round.
struct pace_key {
  round_key round;
  std::string study;
  std::size_t build = 0;
  int threads = 1;
  std::string precision;
  auto operator<=>(const pace_key&) const = default;
};

/// What a round says of a point: the unit of all statistics.
struct round_value {
  phases mean;                      ///< over its repetitions and their steps
  std::vector<phases> repetitions;  ///< each the mean over its steps
};

/// Points that may stand in one table: the same study, machine and build, and the same problem;
/// they differ in backend, isa, grid, block, granularity, M and threads only, which are empty in `common`.
struct series {
  std::string study;
  std::size_t build = 0;              ///< which of the different machines and builds
  std::string environment;            ///< id of the first environment row of that build
  std::string build_name;             ///< its compiler and revision
  std::optional<std::uint64_t> seed;  ///< if the particles depend on it
  struct point common;
};

/// All finished rounds of one point.
struct measured_point {
  struct point point;
  std::size_t series = 0;
  int cores = 1;
  std::size_t steps = 0;        ///< timed steps per repetition
  std::size_t repetitions = 0;  ///< per round, the most
  std::map<round_key, round_value> rounds;
  std::optional<work_row> work;
  std::optional<thread_times> busy_s, waiting_s;                 ///< mean over all timed steps
  std::optional<counters_row> counters;                          ///< mean over all timed steps
  std::optional<std::uint64_t> peak_rss_bytes, workspace_bytes;  ///< the most of all steps
  std::string fingerprint;                                       ///< of the first row
};

/// A point with rows that did not pass the verification; those rows are in no other place.
struct failed_point {
  struct point point;
  std::string study;
  std::size_t rows = 0;
  std::string error;
};

/// The rows of some files, ordered by series and point.
struct measurements {
  std::vector<std::string> sources;
  std::vector<environment_row> environments;
  std::vector<struct series> series;
  std::map<std::string, std::size_t> build_of_environment;
  std::vector<peak_row> peaks;       ///< the best of each environment, number of threads and precision
  std::map<pace_key, double> paces;  ///< multiply-adds, flop/s, mean over the round's repetitions
  std::size_t finished_rounds = 0, void_rounds = 0;
  std::optional<double> others_share;  ///< the largest of a finished round
  bool compares_builds = false;        ///< different builds were measured in the same rounds
  std::vector<measured_point> points;
  std::vector<failed_point> failed;
  std::vector<std::string> caveats;
};

/// Collects the rows of finished rounds. A point's round with an unverified row is left out as a whole. Throws
/// pairsum::error with one line if the rows come from different machines or builds (host, cpu, compiler, flags, git,
/// dirty, binding), unless these were measured in the same rounds, so that they are the factor compared, or
/// `allow_mixed`; then they form different series.
measurements collect(const std::vector<rows_file>& files, bool allow_mixed);

/// The median over the rounds of one phase; empty if it was not timed in all of them.
std::optional<double> median_of(const measured_point& point, std::optional<double> phases::*phase);

/// The values of one phase, one per round in which it was timed.
std::vector<double> values_of(const measured_point& point, std::optional<double> phases::*phase);

/// The median of one phase, if it took time in every round: what can be compared. Empty otherwise.
std::optional<double> comparable_time(const measured_point& point, std::optional<double> phases::*phase);

/// The share of the threads' time in the passes that they spend waiting; empty if that was not observed.
std::optional<double> wait_share(const measured_point& point);

/// What the machine does at best, measured by the point's build with so many threads; null if that was not measured.
const peak_row* peak_of(const measurements& all, const measured_point& point, int threads);

/// Backend, cells and threads in one text: "symmetric_omp M=6 threads=2".
std::string label(const point& p);

/// The same for a caveat: with several series, the problem too.
std::string label(const measurements& all, const measured_point& p);

/// "A, B, C": at most three of the texts, then how many more there are.
std::string first_few(const std::vector<std::string>& texts);

}  // namespace pairsum::harness
