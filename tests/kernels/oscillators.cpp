#include "oscillators.hpp"

#include "backends/naive.hpp"
#include "backends/symmetric.hpp"
#include "interactions/count.hpp"
#include "oscillator_scene.hpp"
#include "sum/enrol_everywhere.hpp"

namespace pairsum::test_kit {
namespace {

template <int D, class R>
void enrol(registry& r) {
  enrol_everywhere<oscillators<D, R>>(r, backend_list<naive, symmetric>());
  enrol_everywhere<count<D, R>>(r, backend_list<naive, symmetric>());
}

}  // namespace

const registry& oscillator_registry() {
  static const registry all = [] {
    registry r;
    enrol<3, double>(r);
#ifndef PAIRSUM_SANITIZED
    enrol<1, double>(r);
    enrol<2, double>(r);
    enrol<3, float>(r);
#endif
    return r;
  }();
  return all;
}

}  // namespace pairsum::test_kit
