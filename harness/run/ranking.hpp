#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/rows/row.hpp"
#include "harness/stats/holm.hpp"
#include "harness/stats/interval.hpp"

namespace pairsum::harness {

/// A measured point, against the fastest of its problem.
struct ranked {
  point what;
  std::string build;                    ///< which of the builds that are compared; else empty
  std::map<int, double> step_s, sum_s;  ///< by round: mean over its steps
  double pairs = 0;                     ///< interacting pairs of each step; 0: not known, for some particles left
  std::uint64_t lost = 0;               ///< particles that left Omega during its steps, at most
  std::string error;                    ///< why it failed its verification
  /// Its step over the fastest's, paired by the rounds that both have; without any, of the geometric means.
  ratio_estimate ratio{1, {}, 0, {}};
  /// What failed, and what lost particles and so did less than the others, is no answer.
  bool has_rank() const { return error.empty() && lost == 0 && !step_s.empty(); }
  bool is_slower = false;  ///< the difference is resolved, at 95 % for all points of the problem together
};

/// The points that solve one problem (case, particles, physics, time step), the fastest first; those without a rank
/// last. The fastest has the smallest geometric mean over its rounds.
using ranking = std::vector<ranked>;

/// What two points that may be compared have in common: "dam_break 3D, dx 0.02, rest, H = 2 dx, ferrari09, wendland_c2,
/// euler, order lattice".
std::string problem_words(const point& p);

/// The largest problem (the most particles) first.
/// @param builds words for environments, if a point counts for each build that measured it; else empty
std::vector<ranking> rank(const std::vector<sample>& samples, const std::map<std::string, std::string>& builds = {});

/// Words that tell the builds of these environments apart: compiler, revision or flags, else the environment.
std::map<std::string, std::string> build_words(const std::vector<environment_row>& environments);

}  // namespace pairsum::harness
