#include <pairsum/vector/listers.hpp>

#include <algorithm>
#include <vector>

#include <pairsum/core/isa.hpp>

namespace pairsum {
namespace {

template <int D, class... Isas>
std::vector<vector_lister<D>> those_that_run(isa_list<Isas...>) {
  std::vector<vector_lister<D>> all;
  const auto names = isa_names();
  const auto take = [&]<class Isa>(const Isa* isa) {
    if (std::ranges::find(names, Isa::name) != names.end()) all.push_back(lister_on<D>(isa));
  };
  (take(static_cast<const Isas*>(nullptr)), ...);
  return all;
}

}  // namespace

template <int D>
std::span<const vector_lister<D>> vector_listers() {
  static const std::vector<vector_lister<D>> all = those_that_run<D>(isa_list<PAIRSUM_ISA_LIST>());
  return all;
}
template std::span<const vector_lister<1>> vector_listers();
template std::span<const vector_lister<2>> vector_listers();
template std::span<const vector_lister<3>> vector_listers();

}  // namespace pairsum
