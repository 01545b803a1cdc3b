#pragma once
#include "vector/highway.hpp"

namespace pairsum {

#if HWY_CAP_GE512 && HWY_ARCH_X86
namespace root_detail {
using d8 = hwy::HWY_NAMESPACE::Full512<double>;
using f16 = hwy::HWY_NAMESPACE::Full512<float>;

HWY_INLINE hwy::HWY_NAMESPACE::Vec<d8> inverse_root(d8, hwy::HWY_NAMESPACE::Vec<d8> x) {
  return hwy::HWY_NAMESPACE::Vec<d8>{_mm512_rsqrt14_pd(x.raw)};
}
HWY_INLINE hwy::HWY_NAMESPACE::Vec<f16> inverse_root(f16, hwy::HWY_NAMESPACE::Vec<f16> x) {
  return hwy::HWY_NAMESPACE::Vec<f16>{_mm512_rsqrt14_ps(x.raw)};
}
}  // namespace root_detail
#endif

/// sqrt(a) lane by lane for finite a >= 0, NaN for NaN; with AVX-512 within 1 ulp for a above 1e-290 (in float 1e-36),
/// and at most the root of that below.
///
/// The root instruction of AVX-512 takes many times as long as a multiply-add of its width. Here y = 1/sqrt(a) (1 + d),
/// |d| < 2^-14, comes from a table, and with t = a y, e = 1 - t y = -2 d - d^2 the series sqrt(a) = t (1 - e)^(-1/2) =
/// t (1 + e/2 + 3/8 e^2 + 5/16 e^3 + ...) does the rest: what is left out is 35/128 e^4 < 2^-53 in double, and in float
/// 5/16 e^3 < 2^-40.
template <class D, class V>
HWY_INLINE V root_of([[maybe_unused]] D d, V a) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_CAP_GE512 && HWY_ARCH_X86
  if constexpr (hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) == 64) {
    using R = hn::TFromD<D>;
    constexpr bool is_double = sizeof(R) == 8;
    // The table has no number for 0. A NaN stays: of two operands, Max hands on the second.
    const V x = hn::Max(hn::Set(d, R(is_double ? 1e-290 : 1e-36)), a);
    const V y = root_detail::inverse_root(d, x), t = hn::Mul(x, y), e = hn::NegMulAdd(t, y, hn::Set(d, R(1)));
    V series = hn::Set(d, R(0.375));
    if constexpr (is_double) series = hn::MulAdd(e, hn::Set(d, R(0.3125)), series);
    return hn::MulAdd(hn::Mul(t, e), hn::MulAdd(series, e, hn::Set(d, R(0.5))), t);
  } else
#endif
    return hn::Sqrt(a);
}

}  // namespace pairsum
