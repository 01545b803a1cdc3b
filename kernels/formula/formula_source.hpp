#pragma once
// What a source in formulas/ is: PAIRSUM_FORMULAS(ferrari09, smoothed) or PAIRSUM_FORMULAS(count, plain).
#include <pairsum/core/precision.hpp>
#include <pairsum/formula/formulas.hpp>
#include <pairsum/smoothing/all_smoothings.hpp>
#ifdef PAIRSUM_ISA
#include <pairsum/vector/compiled_lanes.hpp>
#else
#include <pairsum/formula/entry.hpp>
#include <pairsum/formula/words.hpp>
#endif

namespace pairsum {

/// Sums of interaction I on one instruction set, defined where that is compiled.
template <class I>
lane_sum<I::dim, typename I::real> lanes_on(const isas::avx512*);
template <class I>
lane_sum<I::dim, typename I::real> lanes_on(const isas::avx2*);
template <class I>
lane_sum<I::dim, typename I::real> lanes_on(const isas::sse4*);
template <class I>
lane_sum<I::dim, typename I::real> lanes_on(const isas::neon*);

#ifdef PAIRSUM_ISA
template <class I>
lane_sum<I::dim, typename I::real> lanes_on(const isas::PAIRSUM_ISA*) {
  return compiled_lanes<I>(isas::PAIRSUM_ISA::name);
}
/// Compiles the sums of all these.
template <class Types>
struct compile_types;
template <class... I>
struct compile_types<formula_types<I...>> {
  using function = void (*)();
  template <class One>
  static function address() {
    if constexpr (takes_lanes<One>)
      return reinterpret_cast<function>(
          static_cast<lane_sum<One::dim, typename One::real> (*)(const isas::PAIRSUM_ISA*)>(&lanes_on<One>));
    return nullptr;
  }
  static function of(std::size_t k) {
    const function all[] = {address<I>()..., nullptr};
    return all[k];
  }
};
#else
/// Those of precision mixed that lanes carry.
template <class... I>
void append_entries(formula_types<I...>, std::vector<formula_entry>& to) {
  const auto one = [&]<class T>(const T*) {
    if constexpr (!is_mixed<T> || takes_lanes<T>) to.push_back(formula_entry_of<T>());
  };
  (one(static_cast<const I*>(nullptr)), ...);
}

template <class I>
std::vector<lane_sum<I::dim, typename I::real>> lanes_of() {
  std::vector<lane_sum<I::dim, typename I::real>> all;
  if constexpr (takes_lanes<I>)
    each_that_runs(isa_list<PAIRSUM_ISA_LIST>(),
                   [&](const auto* isa) { all.push_back(row_rates<I>::completed(lanes_on<I>(isa))); });
  return all;
}
#endif

/// The same types in mixed precision.
template <class... I>
formula_types<mixed<I>...> in_mixed(formula_types<I...>) {
  return {};
}

}  // namespace pairsum

#define PAIRSUM_TYPES_OF_smoothed(word, D, R) with_each<word, D, R>(smoothing_list<PAIRSUM_SMOOTHING_LIST>())
#define PAIRSUM_TYPES_OF_plain(word, D, R) formula_types<word<D, R>>()
#define PAIRSUM_TYPES_IN_double(kind, word) PAIRSUM_TYPES_OF_##kind(word, PAIRSUM_DIM, double)
#define PAIRSUM_TYPES_IN_float(kind, word) PAIRSUM_TYPES_OF_##kind(word, PAIRSUM_DIM, float)
#define PAIRSUM_TYPES_IN_mixed(kind, word) in_mixed(PAIRSUM_TYPES_OF_##kind(word, PAIRSUM_DIM, double))

#ifdef PAIRSUM_ISA
#define PAIRSUM_FORMULAS(word, kind)                                                                       \
  namespace pairsum {                                                                                      \
  template struct compile_types<decltype(PAIRSUM_JOIN(PAIRSUM_TYPES_IN_, PAIRSUM_PRECISION)(kind, word))>; \
  }
#else
#define PAIRSUM_FORMULAS(word, kind)                                                                          \
  namespace pairsum {                                                                                         \
  void PAIRSUM_JOIN(formulas_of_, word)(place<PAIRSUM_DIM, precisions::PAIRSUM_JOIN(in_, PAIRSUM_PRECISION)>, \
                                        std::vector<formula_entry>& to) {                                     \
    append_entries(PAIRSUM_JOIN(PAIRSUM_TYPES_IN_, PAIRSUM_PRECISION)(kind, word), to);                       \
  }                                                                                                           \
  }
#endif
