#pragma once

#include <string>
#include <vector>

#include <pairsum/sum/backend_traits.hpp>
#include "harness/report/evaluations.hpp"
#include "harness/report/measured.hpp"

namespace pairsum::harness {

/// A backend on a ladder: as it was at its best there.
struct rung {
  const measured_point* p;
  round_values times;
  double time_s;  ///< their median
};

/// The backends of a series, fastest first, and the one that all are compared with.
struct ladder {
  std::size_t series;
  std::string at;  ///< "one_thread", or "most_threads" of each backend
  std::vector<rung> rungs;
  std::size_t base;

  const rung& base_rung() const { return rungs[base]; }
  /// The backend's place from 0; empty if it is not there.
  std::optional<std::size_t> place_of(const std::string& backend) const;
};

/// Backends of which the first that was measured is the base: the gather, which needs no strategy.
inline constexpr const char* ladder_bases[] = {"naive_omp", "naive_tbb", "naive"};

/// The ladders of every series with a base and at least two backends beside it.
std::vector<ladder> ladders_of(const measurements& all);

/// What the backend says of itself; nullptr for one that this build does not know.
const backend_traits* traits_of(const std::string& backend);

/// A series in a few words: "dam_break 3D", "random_clustered 3D, H = 0.4 dx".
std::string world_words(const measurements& all, std::size_t series);

}  // namespace pairsum::harness
