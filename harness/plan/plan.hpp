#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/sum/registry.hpp>
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Points to be measured together: lists of levels, which are crossed, and the number of repetitions.
struct run_request {
  std::string study = "run", part = "run";
  std::string case_name = "dam_break";
  std::vector<std::string> particles;        ///< files in place of a case; see take_particles()
  std::map<std::string, std::string> hints;  ///< what they do not say, by the words of particle_hints()
  std::string particles_hash;                ///< of what was read; empty: not read yet
  double H_in_spacings = 0;                  ///< of files where nothing says H; 0: that is an error
  std::vector<double> dx{0.02};
  std::vector<std::string> states{"rest"};
  std::vector<std::string> backends{"naive_omp", "symmetric_omp"};
  std::vector<int> M{6, 7};
  std::vector<int> threads{1};
  std::vector<int> shared_threads;         ///< threads of all ranks together: each has its share, at least 1
  std::vector<int> ranks{1};               ///< processes of an MPI job
  std::vector<std::string> cuts{"twice"};  ///< who sums pairs across ranks: cut_words
  int dim = 3;
  double H = 0;  ///< 0: 2 dx
  std::vector<std::string> orders{"lattice"}, precisions{"double"}, interactions{"ferrari09"},
      smoothings{"wendland_c2"}, integrators{"euler"}, granularities{"default"};
  std::vector<std::string> grids{"hashed_grid"};
  std::vector<std::string> isas{"default"};  ///< scalar, best, sets, or each backend's default
  std::vector<std::string> blocks{"auto"};   ///< of backends that go over blocks
  std::string outside = "error";
  double dt = 1e-5;
  int steps = 5;
  int repetitions = 1;  ///< of each point in a round, that is in one process
  std::uint64_t seed = 1;
};

/// The word that stands for a case where particles come from files, and for their state as it was read.
inline constexpr std::string_view case_of_files = "file", state_of_files = "read";

/// The states that a case can be in, for messages and lists: those of the library, and evolved:T.
std::vector<std::string_view> case_state_words();

/// Throws pairsum::error, in one line, for a request that makes no sense (unknown words, numbers out of range), before
/// anything is computed or written.
void check_request(const run_request& r, const registry& all = registry::instance());

/// One world: the points of a world share particles and reference, so they have the same dx, state, precision,
/// interaction and smoothing kernel. Headline first: in the order of the request; particle numbers are filled in later.
using world_plan = std::vector<point>;

/// The word for a backend's own granularity.
inline constexpr std::string_view default_granularity = "default";

/// What stands for the smoothing kernel of an interaction that takes none.
inline constexpr std::string_view no_smoothing = "none";

/// What stands for the blocks of a backend that has none.
inline constexpr std::string_view no_block = "none";

/// Who sums a pair of particles that two ranks hold.
inline constexpr std::string_view cut_words[] = {"twice", "once"};
/// What stands for that where there is one rank.
inline constexpr std::string_view no_cut = "none";

/// The points, grouped by world. A serial backend appears once per variant, with 1 thread; an interaction that takes no
/// smoothing kernel appears once; so do a sum on one rank, and the sum of one side of each pair, which knows no cut but
/// "twice". A backend that was not built for a world's formula and precision is left out of it;
/// check_request refuses a word that no world has.
std::vector<world_plan> expand(const run_request& r, const registry& all = registry::instance());

/// The order in which repetition `repetition` of round `round` measures `n` points: a permutation that depends on
/// (seed, round, repetition) alone.
std::vector<std::size_t> shuffled_order(std::size_t n, std::uint64_t seed, int round, int repetition);

}  // namespace pairsum::harness
