// Compiled once for each instruction set, with its flags: the lister of its vector units.
#include <pairsum/core/places.hpp>
#include <pairsum/formula/formulas.hpp>
#include <pairsum/vector/lane_lister.hpp>
#include <pairsum/vector/listers.hpp>

namespace pairsum {

using isa = isas::PAIRSUM_ISA;

template <int D>
vector_lister<D> lister_on(const isa*) {
  using lister = lane_lister<D, lane_vector<float>>;
  return {isa::name, &lister::list};
}
#define PAIRSUM_LISTER(D) template vector_lister<D> lister_on<D>(const isa*);
PAIRSUM_EACH_D(PAIRSUM_LISTER)

}  // namespace pairsum
