#pragma once
#include <array>
#include <concepts>
#include <string_view>

#include "core/team.hpp"
#include "sum/conflict_avoidance.hpp"
#include "sum/probe.hpp"
#include "sum/problem.hpp"

namespace pairsum {

/// What a backend says of itself.
struct backend_traits {
  std::string_view name;         ///< file = type = CLI word = JSON value = legend
  std::string_view description;  ///< one line
  std::string_view aliases;      ///< what the field calls it
  runtime threads;               ///< whose threads it runs on
  bool symmetric;                ///< each pair computed once, both particles updated
  bool deterministic;            ///< bit-identical for every number of threads
  bool accumulates;              ///< adds to the rates, which the caller has zeroed; else it writes each rate once
  int evaluations_per_pair;      ///< how often a sum evaluates the formula for an interacting fluid pair
  bool sweeps_per_colour;        ///< a sum goes over all particles once per colour of its pattern; else once
  bool keeps_pairs;              ///< prepare tests the distances and lists the pairs; else sum tests them
  granularity loop{};            ///< how it shares out its loops unless the team says; none without such loops
  bool vector = false;           ///< runs on vector units, of which setup::isa chooses
  bool blocks = false;           ///< goes over blocks of cells, which setup::block shapes
  int cells_per_reach = 1;       ///< how many of the cells that it sorts particles into span the reach
  double skin = 0;               ///< of its lists, in units of H: they serve until a particle has moved by half of it
  std::array<int, 3> colours{2, 4, 8};  ///< of a symmetric pattern in 1D, 2D and 3D: passes with a barrier between
  conflict_avoidance conflicts = conflict_avoidance::unsaid;  ///< how threads are kept apart

  /// How often a sum goes over the particles in `dim` dimensions.
  constexpr int sweeps(int dim) const { return sweeps_per_colour ? colours[static_cast<std::size_t>(dim - 1)] : 1; }
};

/// A summation algorithm: `traits`, and a `workspace<I>` for interaction I that is kept from step to step, with
///   prepare(problem, team, probe)   refreshes its own buffers, lists, colours (timed apart)
///   sum(problem, team, probe)       computes; it does not time, print, allocate its output or know the formula
template <class B, class I>
concept backend = requires(typename B::template workspace<I> w, const problem<I>& p, const team& t, no_probe& probe) {
  { B::traits } -> std::convertible_to<backend_traits>;
  w.prepare(p, t, probe);
  w.sum(p, t, probe);
};

}  // namespace pairsum
