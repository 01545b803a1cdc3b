#pragma once
#include <pairsum/sum/formula.hpp>
#include <pairsum/vector/highway.hpp>

/// Does the instruction set of this compilation have lanes? Not without SSSE3 or NEON, nor with vectors of unknown
/// length, which no struct can hold.
#define PAIRSUM_LANES                                                                                                 \
  (HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SVE_256 && HWY_TARGET != HWY_SVE2_128 && \
   !HWY_HAVE_SCALABLE)
#if PAIRSUM_LANES
#include <pairsum/vector/lane_rows_sum.hpp>
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
/// The sums of interaction I on the vector units that this is compiled for; row_rates<I> completes them.
template <class I>
lane_sum<I::dim, typename I::real> compiled_lanes(std::string_view isa) {
  using V = lane_vector<pair_real<I>>;
  using rows = lane_rows_sum<I, V>;
  lane_sum<I::dim, typename I::real> sum{isa, lane_count<pair_real<I>>, HWY_NATIVE_FMA != 0, {}, nullptr};
  sum.pairs.both[static_cast<unsigned>(update::plain)] = &rows::both;
  sum.pairs.both[static_cast<unsigned>(update::split)] = &rows::both;
  sum.pairs.own = &rows::own;
  sum.pairs.half_stencils = &rows::half_stencils;
  sum.pairs.full_stencils = &rows::full_stencils;
  return sum;
}
#endif

}  // namespace pairsum
