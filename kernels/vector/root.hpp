#pragma once
#include <pairsum/vector/highway.hpp>

namespace pairsum {

/// sqrt(a) from y = (1 + d)/sqrt(a), |d| < 2^-14, and 0 where y is 0, for sets that round a product and a sum once.
/// With t = a y, e = 1 - t y = -2 d - d^2:
///
///   sqrt(a) = t (1 - e)^(-1/2) = t (1 + e/2 + 3/8 e^2 + 5/16 e^3 + 35/128 e^4 + ...)
///
/// In double the term of e^4, in float that of e^3 is less than half a unit in the last place; it is left out.
template <class D, class V>
HWY_INLINE V root_by_series(D d, V a, V y) {
  namespace hn = hwy::HWY_NAMESPACE;
  using R = hn::TFromD<D>;
  const V t = hn::Mul(a, y), e = hn::NegMulAdd(t, y, hn::Set(d, R(1)));
  V series = hn::Set(d, R(0.375));
  if constexpr (sizeof(R) == 8) series = hn::MulAdd(e, hn::Set(d, R(0.3125)), series);
  return hn::MulAdd(hn::Mul(t, e), hn::MulAdd(series, e, hn::Set(d, R(0.5))), t);
}

#if HWY_CAP_GE512 && HWY_ARCH_X86
namespace root_detail {
/// From the processor's table; 0 for 0.
HWY_INLINE __m512d inverse_root(__m512d a) {
  return _mm512_maskz_rsqrt14_pd(_mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_NEQ_UQ), a);
}
HWY_INLINE __m512 inverse_root(__m512 a) {
  return _mm512_maskz_rsqrt14_ps(_mm512_cmp_ps_mask(a, _mm512_setzero_ps(), _CMP_NEQ_UQ), a);
}
}  // namespace root_detail
#endif

/// sqrt(a) lane by lane: the rounded root; with AVX-512, whose root instruction takes many times as long as a
/// multiply-add of its width, that or one of its neighbours. 0 for 0, NaN for NaN and below 0. With AVX-512 a must be
/// finite (NaN for infinity), and in float not subnormal.
template <class D, class V>
HWY_INLINE V root_of([[maybe_unused]] D d, V a) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_CAP_GE512 && HWY_ARCH_X86
  if constexpr (hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) == 64)
    return root_by_series(d, a, V{root_detail::inverse_root(a.raw)});
  else
#endif
    return hn::Sqrt(a);
}

}  // namespace pairsum
