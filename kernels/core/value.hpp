#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

/// The few operations that formulas use beyond + - * /, for scalars. A vector of lanes or a value that carries an error
/// bound brings overloads of the same names, found by argument-dependent lookup, so that one formula source serves them
/// all.
namespace pairsum {

template <class T>
concept scalar = std::is_arithmetic_v<T>;

template <scalar T>
constexpr T select(bool mask, T a, T b) {
  return mask ? a : b;
}

template <scalar T>
T square_root(T a) {
  return std::sqrt(a);
}

template <scalar T>
T exponential(T a) {
  return std::exp(a);
}

template <scalar T>
constexpr T maximum(T a, T b) {
  return a < b ? b : a;
}

template <scalar T>
constexpr T absolute(T a) {
  return a < T(0) ? -a : a;
}

/// a*b + c, rounded once where the hardware does so at full speed and twice elsewhere; never left to the compiler.
inline double fused(double a, double b, double c) {
#ifdef __FP_FAST_FMA
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
inline long double fused(long double a, long double b, long double c) { return a * b + c; }
inline float fused(float a, float b, float c) {
#ifdef __FP_FAST_FMAF
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// a^n for a whole n >= 0 by repeated squaring.
template <class T>
constexpr T power(T a, int n) {
  T result = T(1);
  for (; n > 0; n >>= 1) {
    if (n & 1) result = result * a;
    a = a * a;
  }
  return result;
}

}  // namespace pairsum
