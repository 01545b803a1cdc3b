#pragma once
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

// The smoothing kernels a second time, in long double: as their authors print them, gradients by the rules of calculus.
namespace pairsum::test_kit {

using real_t = long double;
constexpr real_t pi_l = std::numbers::pi_v<real_t>;

/// W and W'/r at one distance.
struct kernel_values {
  real_t W, F;
};

/// sum of c_k q^k and its derivative.
inline kernel_values polynomial(const std::vector<real_t>& c, real_t q) {
  kernel_values p{0, 0};
  for (std::size_t k = c.size(); k-- > 0;) p = {p.W * q + c[k], p.F * q + p.W};
  return p;
}

/// C (1-q)^n P(q) with q = r/H (Dehnen & Aly 2012, table 1, where C is in units of H^-D).
inline kernel_values wendland(real_t C, int n, const std::vector<real_t>& P, real_t r, real_t H) {
  const real_t q = r / H, s = 1 - q;
  const auto [p, dp] = polynomial(P, q);
  return {C * std::pow(s, n) * p, C * std::pow(s, n - 1) * (s * dp - n * p) / (r * H)};
}

/// The truncated powers of the B-spline: sigma/4 ((2-s)^3 - 4 (1-s)^3), each only where its base is positive; s = 2r/H.
inline kernel_values m4_spline(int D, real_t r, real_t H) {
  const real_t h = H / 2, s = r / h, a = std::max<real_t>(2 - s, 0), b = std::max<real_t>(1 - s, 0);
  const real_t sigma = D == 1 ? 2 / (3 * h) : D == 2 ? 10 / (7 * pi_l * h * h) : 1 / (pi_l * h * h * h);
  return {sigma / 4 * (a * a * a - 4 * b * b * b), sigma / 4 * (-3 * a * a + 12 * b * b) / (r * h)};
}

/// exp(-(r/h)^2), h = H/3, over its integral within 3h.
inline kernel_values cut_gaussian(int D, real_t r, real_t H) {
  const real_t h = H / 3, tail = std::exp(real_t(-9)), root = std::sqrt(pi_l), erf3 = std::erf(real_t(3));
  const real_t integral = D == 1   ? root * erf3 * h
                          : D == 2 ? pi_l * (1 - tail) * h * h
                                   : (pi_l * root * erf3 - 6 * pi_l * tail) * h * h * h;
  const real_t W = std::exp(-(r / h) * (r / h)) / integral;
  return {W, -2 / (h * h) * W};
}

/// The kernel of that name at 0 < r < H.
inline kernel_values literature(std::string_view name, int D, real_t r, real_t H) {
  const auto C = [&](real_t c1, real_t c2, real_t c3) {
    return D == 1 ? c1 / H : D == 2 ? c2 / (pi_l * H * H) : c3 / (pi_l * H * H * H);
  };
  const real_t third = real_t(1) / 3;
  if (name == "wendland_c2")
    return D == 1 ? wendland(1.25L / H, 3, {1, 3}, r, H) : wendland(C(0, 7, 10.5L), 4, {1, 4}, r, H);
  if (name == "wendland_c4")
    return D == 1 ? wendland(1.5L / H, 5, {1, 5, 8}, r, H)
                  : wendland(C(0, 9, 495.0L / 32), 6, {1, 6, 35 * third}, r, H);
  if (name == "wendland_c6")
    return D == 1 ? wendland(55.0L / 32 / H, 7, {1, 7, 19, 21}, r, H)
                  : wendland(C(0, 78.0L / 7, 1365.0L / 64), 8, {1, 8, 25, 32}, r, H);
  if (name == "cubic_spline") return m4_spline(D, r, H);
  if (name == "gaussian") return cut_gaussian(D, r, H);
  return {NAN, NAN};
}

}  // namespace pairsum::test_kit
