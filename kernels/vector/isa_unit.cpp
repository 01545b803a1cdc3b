// Compiled once for each instruction set, with its flags: who finds pairs on its vector units.
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
template vector_lister<1> lister_on<1>(const isa*);
template vector_lister<2> lister_on<2>(const isa*);
template vector_lister<3> lister_on<3>(const isa*);

}  // namespace pairsum
