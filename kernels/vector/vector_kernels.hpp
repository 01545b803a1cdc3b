#pragma once
#include <string_view>
#include <vector>

#include "vector/highway.hpp"
#include "vector/tile_problem.hpp"

/// Are there lanes in what this is compiled for? Not without SSSE3 or NEON; nor with vectors of unknown length, of
/// which no struct can be made.
#define PAIRSUM_LANES                                                                                                 \
  (HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SVE_256 && HWY_TARGET != HWY_SVE2_128 && \
   !HWY_HAVE_SCALABLE)
#if PAIRSUM_LANES
#include "vector/tile_kernel.hpp"
#endif

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
  return "none";
#endif
}

#if PAIRSUM_LANES
/// The kernels of the instruction set this is compiled for.
template <class I>
tile_kernels<I> compiled_kernels() {
  using kernel = tile_kernel<I, lane_vector<pair_real<I>>>;
  return {compiled_vector_isa(), lane_count<pair_real<I>>, HWY_NATIVE_FMA != 0, &kernel::template sum<true>,
          &kernel::template sum<false>};
}
#endif

template <class I>
std::vector<tile_kernels<I>> vector_kernels() {
#if PAIRSUM_LANES
  return {compiled_kernels<I>()};
#else
  return {};
#endif
}

}  // namespace pairsum
