#pragma once
#include <pairsum/formula/flop_count.hpp>
#include <pairsum/formula/mixed.hpp>
#include <pairsum/sum/costs.hpp>

namespace pairsum {
namespace costs_detail {

/// An S whose values are all inputs of the formula. Where a formula branches, what it does at these values is counted.
template <class S>
S inputs(flop_tape& tape) {
  S s = zero<S>();
  each_scalar(s, [&](auto& a, int) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(a)>, counted>) a = counted::input(tape, 1);
  });
  return s;
}

/// Wants what a sum of rates becomes when `more` is added to it.
template <class S>
void want_sum(flop_tape& tape, const S& more) {
  S sum = inputs<S>(tape);
  add(sum, more);
  each_scalar(sum, [&](const auto& a, int) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(a)>, counted>) tape.want(a.step);
  });
}

template <class S>
int bytes_of() {
  int bytes = 0;
  each_scalar(zero<S>(), [&](const auto& a, int) { bytes += static_cast<int>(sizeof a); });
  return bytes;
}

}  // namespace costs_detail

/// Flops of a distance test, counted: what is declared as distance_test_flops.
template <int D>
int count_distance_test() {
  flop_tape tape;
  const vec<D, counted> x_i = costs_detail::inputs<vec<D, counted>>(tape),
                        x_j = costs_detail::inputs<vec<D, counted>>(tape);
  tape.want((norm2<D, counted>(x_i - x_j) < counted(1)).outcome.step);
  return tape.take();
}

/// Flops of the pairs of a formula, counted by running it: its own, and those of adding to the rates. r and r.r are
/// known from the distance test.
template <class I>
pair_flops count_flops(const I& formula) {
  using namespace costs_detail;
  using particle = typename I::template particle<counted>;
  flop_tape tape;
  const auto r = inputs<vec<I::dim, counted>>(tape);
  const auto r2 = counted::input(tape, 0.5);
  const auto i = inputs<particle>(tape), j = inputs<particle>(tape);
  pair_flops n;
  const auto c = formula.pair(r, r2, i, j);
  want_sum(tape, c.to_i);
  n.one_sided = tape.take();
  want_sum(tape, c.to_i);
  want_sum(tape, c.to_j);
  n.both = tape.take();
  if constexpr (has_boundary<I>) {
    const auto b = inputs<typename I::template boundary_particle<counted>>(tape);
    want_sum(tape, formula.boundary(r, r2, i, b));
    n.boundary = tape.take();
  }
  return n;
}

/// What interaction I costs by the piece.
template <class I>
formula_costs costs_of(const I& formula) {
  using namespace costs_detail;
  constexpr int real = sizeof(typename I::real), value = sizeof(pair_real<I>);
  formula_costs c;
  c.dim = I::dim;
  c.distance_test = distance_test_flops(I::dim);
  c.counted = count_flops(formula);
  if constexpr (requires { I::flops; }) c.declared = I::flops;
  c.boundary_reach = boundary_reach<I>();
  c.fluid_bytes = I::dim * value + bytes_of<particle_of<I>>() / (real / value);
  c.boundary_bytes = I::dim * real + bytes_of<boundary_particle_of<I>>();
  c.rates_bytes = bytes_of<rates_of<I>>();
  return c;
}

}  // namespace pairsum
