#pragma once
#include <array>
#include <string_view>

#include <pairsum/core/team.hpp>
#include <pairsum/sum/conflict_avoidance.hpp>

namespace pairsum {

/// What a backend says of itself. A schedule's traits say what differs from these defaults; the backend adds its name
/// and its runtime.
struct backend_traits {
  std::string_view name = {};         ///< file = CLI word = JSON value = legend
  std::string_view description = {};  ///< one line
  std::string_view aliases = {};      ///< names used elsewhere
  runtime threads = runtime::serial;  ///< whose threads it runs on
  bool symmetric = true;              ///< each pair computed once, both particles updated
  bool deterministic = true;          ///< bit-identical for every number of threads
  bool sweeps_per_colour = false;     ///< a sum goes over all particles once per colour of its pattern; else once
  bool keeps_pairs = false;           ///< prepare tests the distances and lists the pairs; else sum tests them
  granularity loop = {};              ///< how it shares out its loops unless the team says; none without such loops
  bool vector = false;                ///< runs on vector units unless setup::isa says otherwise; else scalar
  bool blocks = false;                ///< goes over blocks of cells, which setup::block shapes
  int cells_per_reach = 1;            ///< how many of the cells that it sorts particles into span the cutoff
  double skin = 0;  ///< of its lists, in units of H: they serve until a particle has moved by half of it
  std::array<int, 3> colours{1, 1, 1};  ///< of a symmetric pattern in 1D, 2D and 3D: passes with a barrier between
  conflict_avoidance conflicts = conflict_avoidance::colours;  ///< how threads are kept apart

  /// How often a sum evaluates the formula for an interacting fluid pair.
  constexpr int evaluations_per_pair() const { return symmetric ? 1 : 2; }
  /// Adds to rates, which are zeroed before; else it writes each rate once (on vector units it adds, too).
  constexpr bool accumulates() const { return symmetric; }
  /// How often a sum goes over the particles in `dim` dimensions.
  constexpr int sweeps(int dim) const { return sweeps_per_colour ? colours[static_cast<std::size_t>(dim - 1)] : 1; }

  /// The traits of a backend that runs a schedule on one runtime.
  constexpr backend_traits on(std::string_view word, runtime r) const {
    backend_traits t = *this;
    t.name = word;
    t.threads = r;
    if (r == runtime::serial) {
      t.loop = {};
      t.conflicts = conflict_avoidance::serial;
    } else if (r == runtime::tbb) {
      t.loop.how = loop.chunk <= 2 ? loop_schedule::simple : loop_schedule::automatic;
    }
    return t;
  }
};

}  // namespace pairsum
