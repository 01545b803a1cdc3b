#include "harness/evolve/simulate_registry.hpp"

#include <pairsum/core/places.hpp>
#include <pairsum/formula/entry.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>
#include <pairsum/vector/own_lanes.hpp>
#include "harness/evolve/ferrari09_hard.hpp"

namespace pairsum::harness {
namespace {

template <int D>
void add_walls(registry& r) {
  if constexpr (is_place<D, double>()) r.add(formula_entry_of<ferrari09_hard<D, double, wendland_c2>>());
}

}  // namespace

const registry& simulate_registry() {
  static const registry extended = [] {
    registry r = registry::instance();
    add_walls<1>(r);
    add_walls<2>(r);
    add_walls<3>(r);
    return r;
  }();
  return extended;
}

}  // namespace pairsum::harness
