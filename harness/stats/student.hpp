#pragma once

namespace pairsum::harness {

/// P(|T| >= |t|), the two-sided p-value of t, of Student's t with `freedom` > 0 degrees of freedom (not necessarily a
/// whole number), by the regularised incomplete beta function (Abramowitz & Stegun, Handbook of Mathematical Functions,
/// eq. 26.7.1 with 26.5.27). Accurate where 1 - cdf would cancel. Throws pairsum::error unless freedom is positive and
/// finite and t is a number; t may be infinite.
double student_t_two_sided(double t, double freedom);

/// The t with P(T <= t) = probability, by Newton's method. Throws pairsum::error unless
/// 0 < probability < 1 and freedom is positive and finite.
double student_t_quantile(double probability, double freedom);

}  // namespace pairsum::harness
