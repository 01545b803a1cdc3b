#include <pairsum/vector/listers.hpp>

#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/formula/formulas.hpp>

namespace pairsum {

template <int D>
std::span<const vector_lister<D>> vector_listers() {
  static const std::vector<vector_lister<D>> all = [] {
    std::vector<vector_lister<D>> listers;
    each_that_runs(isa_list<PAIRSUM_ISA_LIST>(), [&](const auto* isa) { listers.push_back(lister_on<D>(isa)); });
    return listers;
  }();
  return all;
}
#define PAIRSUM_LISTERS(D) template std::span<const vector_lister<D>> vector_listers();
PAIRSUM_EACH_D(PAIRSUM_LISTERS)

}  // namespace pairsum
