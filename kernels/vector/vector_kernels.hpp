#pragma once
#include <string_view>
#include <vector>

#include "vector/tile_kernel.hpp"

namespace pairsum {

/// The word for the instruction set this is compiled for.
constexpr std::string_view compiled_vector_isa() {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return "avx512";
#elif HWY_TARGET == HWY_AVX2
  return "avx2";
#elif HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
  return "sse4";
#elif HWY_TARGET == HWY_NEON
  return "neon";
#else
  return "generic";
#endif
}

/// The kernels of the instruction set this is compiled for.
template <class I>
tile_kernels<I> compiled_kernels() {
  using kernel = tile_kernel<I, lane_vector<typename I::real>>;
  return {compiled_vector_isa(), &kernel::template sum<true>, &kernel::template sum<false>};
}

/// The kernels for interaction I that this machine runs, best first. The library's own interactions have them for every
/// set of isa_names(), compiled apart; one that a user brings has those of the flags it is compiled with.
template <class I>
std::vector<tile_kernels<I>> vector_kernels() {
  return {compiled_kernels<I>()};
}

}  // namespace pairsum
