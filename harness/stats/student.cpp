#include "harness/stats/student.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/SpecialFunctions>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

void check_freedom(double freedom) {
  if (!(freedom > 0 && std::isfinite(freedom)))
    throw error("Student's t needs a positive and finite number of degrees of freedom");
}

/// Density of Student's t (Abramowitz & Stegun, sec. 26.7).
double density(double t, double freedom) {
  const double log_scale = std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2);
  return std::exp(log_scale - (freedom + 1) / 2 * std::log1p(t * t / freedom)) / std::sqrt(freedom * std::numbers::pi);
}

}  // namespace

double student_t_two_sided(double t, double freedom) {
  check_freedom(freedom);
  if (std::isnan(t)) throw error("Student's t needs a number, t is none");
  if (std::isinf(t)) return 0;
  const double square = t * t;
  // P(|T| >= |t|) = I_x(freedom / 2, 1 / 2), x = freedom / (freedom + t^2); for small t, where x is next to 1, the same
  // as 1 - I_{1 - x}(1 / 2, freedom / 2).
  if (square < 1) return 1 - Eigen::numext::betainc(0.5, freedom / 2, square / (freedom + square));
  return Eigen::numext::betainc(freedom / 2, 0.5, freedom / (freedom + square));
}

double student_t_quantile(double probability, double freedom) {
  check_freedom(freedom);
  if (!(probability > 0 && probability < 1)) throw error("a quantile's probability should lie between 0 and 1");
  const double tails = 2 * std::min(probability, 1 - probability);
  // Newton from 0: for t >= 0 the tails are a convex, falling function of t, so no step passes the root.
  double t = 0;
  for (;;) {
    const double step = (student_t_two_sided(t, freedom) - tails) / (2 * density(t, freedom));
    if (!(step > 1e-15 * t)) break;
    t += step;
  }
  return probability < 0.5 ? -t : t;
}

}  // namespace pairsum::harness
