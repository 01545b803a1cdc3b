#pragma once
#include <algorithm>
#include <string_view>

#include <pairsum/core/isa.hpp>

/// The sources in formulas/ are compiled once for each dimension and precision, with PAIRSUM_DIM and PAIRSUM_PRECISION
/// defined, and once more for each instruction set, with its flags and with PAIRSUM_ISA defined, where only sums on its
/// vector units are compiled. PAIRSUM_SMOOTHING_LIST and PAIRSUM_ISA_LIST are what is built, with commas.
#define PAIRSUM_JOIN_(a, b) a##b
#define PAIRSUM_JOIN(a, b) PAIRSUM_JOIN_(a, b)

namespace pairsum {

/// Instruction sets, as types.
namespace isas {
struct avx512 {
  static constexpr std::string_view name = "avx512";
};
struct avx2 {
  static constexpr std::string_view name = "avx2";
};
struct sse4 {
  static constexpr std::string_view name = "sse4";
};
struct neon {
  static constexpr std::string_view name = "neon";
};
}  // namespace isas

template <class... Isas>
struct isa_list {};

/// Calls use(isa) for each of the list that this machine runs, in its order; `isa` is a null pointer that carries the
/// type.
template <class... Isas, class Use>
void each_that_runs(isa_list<Isas...>, Use&& use) {
  const auto names = isa_names();
  const auto use_one = [&]<class Isa>(const Isa* isa) {
    if (std::ranges::find(names, Isa::name) != names.end()) use(isa);
  };
  (use_one(static_cast<const Isas*>(nullptr)), ...);
}

/// Smoothing kernels as parameters.
template <template <int, class> class... Smoothings>
struct smoothing_list {};

template <class... I>
struct formula_types {};

/// An interaction that takes a smoothing kernel, with each of those that are built.
template <template <int, class, template <int, class> class> class Interaction, int D, class R,
          template <int, class> class... S>
formula_types<Interaction<D, R, S>...> with_each(smoothing_list<S...>) {
  return {};
}

}  // namespace pairsum
