#include "oscillators.hpp"

#include <pairsum/pairsum.hpp>
#include "oscillator_scene.hpp"

namespace pairsum::test_kit {
const registry& oscillator_registry() {
  static const registry all = [] {
    registry r = registry::instance();
    r.add(formula_entry_of<oscillators<3, double>>());
#ifndef PAIRSUM_SANITIZED
    r.add(formula_entry_of<oscillators<1, double>>());
    r.add(formula_entry_of<oscillators<2, double>>());
    r.add(formula_entry_of<oscillators<3, float>>());
#endif
    return r;
  }();
  return all;
}

}  // namespace pairsum::test_kit
