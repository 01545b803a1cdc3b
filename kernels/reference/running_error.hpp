#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// A value of working precision R with a bound on how far any evaluation of the same expression in R can be from the
/// exact result: running error analysis (Wilkinson; Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
/// sec. 3.3). A fused multiply-add rounds less often than the bound assumes, so the bound holds with and without
/// contraction. With a unit U coarser than R the bound is for an evaluation in U of inputs that are rounded to U.
template <class R, class U = R>
struct running_error {
  R v = 0;
  double e = 0;

  running_error() = default;
  running_error(R value)  // NOLINT: inputs convert
      : v(value), e(static_cast<R>(static_cast<U>(value)) == value ? 0 : rounded(value) + underflow) {}
  running_error(R value, double bound) : v(value), e(bound) {}
  template <class N>
  requires(std::is_arithmetic_v<N> && !std::is_same_v<N, R>) explicit(false) running_error(N value)
      : running_error(static_cast<R>(value)) {}

  static double rounded(R value) {
    return 0.5 * static_cast<double>(std::numeric_limits<U>::epsilon()) * std::abs(static_cast<double>(value));
  }
  /// What a product or quotient can lose below the smallest normal number.
  static constexpr double underflow = static_cast<double>(std::numeric_limits<U>::denorm_min());
  double size() const { return std::abs(static_cast<double>(v)); }

  friend running_error operator+(const running_error& a, const running_error& b) {
    const R v = a.v + b.v;
    return {v, a.e + b.e + rounded(v)};
  }
  friend running_error operator-(const running_error& a, const running_error& b) {
    const R v = a.v - b.v;
    return {v, a.e + b.e + rounded(v)};
  }
  friend running_error operator*(const running_error& a, const running_error& b) {
    const R v = a.v * b.v;
    return {v, a.size() * b.e + b.size() * a.e + a.e * b.e + rounded(v) + underflow};
  }
  friend running_error operator/(const running_error& a, const running_error& b) {
    const R v = a.v / b.v;
    if (b.size() <= b.e) return {v, std::numeric_limits<double>::infinity()};
    const double size = std::abs(static_cast<double>(v));
    return {v, (a.e + size * b.e) / (b.size() - b.e) + rounded(v) + underflow};
  }
  running_error operator-() const { return {-v, e}; }
  running_error& operator+=(const running_error& b) { return *this = *this + b; }
  running_error& operator-=(const running_error& b) { return *this = *this - b; }
  running_error& operator*=(const running_error& b) { return *this = *this * b; }
  running_error& operator/=(const running_error& b) { return *this = *this / b; }

  friend bool operator<(const running_error& a, const running_error& b) { return a.v < b.v; }
  friend bool operator==(const running_error& a, const running_error& b) { return a.v == b.v; }

  /// Vector units may give a neighbour of the rounded root, which is less than three times `rounded` off.
  friend running_error square_root(const running_error& a) {
    const R v = std::sqrt(a.v);
    const double root = static_cast<double>(v);
    return {v, (a.e < a.size() ? a.e / root : std::sqrt(a.e)) + 3 * rounded(v)};
  }
  /// The C library's exp is within 1 ulp, twice `rounded`; doubled again for safety.
  friend running_error exponential(const running_error& a) {
    const R v = std::exp(a.v);
    constexpr double far = 700;  // beyond, e^a.e is no finite double
    const double spread =
        a.e < far ? std::exp(static_cast<double>(a.v)) * std::expm1(a.e) : std::numeric_limits<double>::infinity();
    return {v, spread + 4 * rounded(v) + underflow};
  }
  friend running_error maximum(const running_error& a, const running_error& b) {
    return {a.v < b.v ? b.v : a.v, std::max(a.e, b.e)};
  }
  friend running_error absolute(const running_error& a) { return {std::abs(a.v), a.e}; }
  friend running_error select(bool mask, const running_error& a, const running_error& b) { return mask ? a : b; }
};

}  // namespace pairsum

namespace Eigen {
template <class R, class U>
struct NumTraits<pairsum::running_error<R, U>> : NumTraits<R> {
  using Real = pairsum::running_error<R, U>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = R;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 4,
    MulCost = 8
  };
};
}  // namespace Eigen
