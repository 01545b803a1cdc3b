#include <pairsum/vector/listers.hpp>

#include <vector>

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
template std::span<const vector_lister<1>> vector_listers();
template std::span<const vector_lister<2>> vector_listers();
template std::span<const vector_lister<3>> vector_listers();

}  // namespace pairsum
