#include <gtest/gtest.h>

#include <pairsum/formula/costs_of.hpp>
#include <pairsum/interactions/count.hpp>
#include <pairsum/interactions/ferrari09.hpp>
#include <pairsum/interactions/monaghan94.hpp>
#include <pairsum/smoothing/all_smoothings.hpp>
#include <pairsum/sum/registry.hpp>

// The flops that interactions and smoothing kernels declare, against those counted by running their formulas.
namespace pairsum {

std::ostream& operator<<(std::ostream& o, const pair_flops& f) {
  return o << "both " << f.both << ", one-sided " << f.one_sided << ", boundary " << f.boundary;
}

namespace {

/// Flops of the results that `make` returns for the inputs it asks for.
template <class F>
int flops_of(F&& make) {
  flop_tape tape;
  double next = 1;
  const counted result = make([&] { return counted::input(tape, next++); });
  tape.want(result.step);
  return tape.take();
}

TEST(flop_count, of_single_operations) {
  EXPECT_EQ(flops_of([](auto in) { return in() + in(); }), 1);
  EXPECT_EQ(flops_of([](auto in) { return in() - in() * in() / in(); }), 3);
  EXPECT_EQ(flops_of([](auto in) { return square_root(in()); }), 1);
  EXPECT_EQ(flops_of([](auto in) { return exponential(in()); }), 1);
  EXPECT_EQ(flops_of([](auto in) { return absolute(maximum(in(), in())); }), 2);
  EXPECT_EQ(flops_of([](auto in) { return select(in() < in(), in(), in()); }), 2);
  EXPECT_EQ(flops_of([](auto in) { return fused(in(), in(), in()); }), 2);
  EXPECT_EQ(flops_of([](auto in) { return -in(); }), 0);
  EXPECT_EQ(flops_of([](auto in) {
              counted a = in();
              a += in();
              a -= in();
              a *= in();
              a /= in();
              return a;
            }),
            4);
}

TEST(flop_count, of_what_compilers_fold) {
  EXPECT_EQ(flops_of([](auto) { return counted(2) * counted(3) + counted(4); }), 0);
  EXPECT_EQ(flops_of([](auto in) { return counted(1) * in() + counted(0); }), 0);
  EXPECT_EQ(flops_of([](auto in) { return counted(0) - in(); }), 0);
  EXPECT_EQ(flops_of([](auto in) { return counted(2) * in(); }), 1);
  EXPECT_EQ(flops_of([](auto in) { return power(in(), 3); }), 2);
}

TEST(flop_count, of_shared_and_of_unused_subexpressions) {
  EXPECT_EQ(flops_of([](auto in) {
              const counted shared = in() * in(), unused = square_root(shared);
              (void)unused;
              return shared + shared;
            }),
            2);
}

TEST(flop_count, of_branches_is_that_of_the_branch_taken) {
  const auto branching = [](auto in) {
    const counted a = in(), b = in();
    if (a < b) return a + b;
    return a * b * a * b;
  };
  EXPECT_EQ(flops_of(branching), 1) << "1 < 2; the comparison is not seen";
}

TEST(flop_count, of_vectors) {
  const auto dot = [](auto in) {
    const vec<3, counted> a(in(), in(), in()), b(in(), in(), in());
    return (a - b).dot(in() * a);
  };
  EXPECT_EQ(flops_of(dot), 3 + 3 + 5);
}

/// What is declared for I, as the test compares it.
template <class I>
std::string wrong_declaration(const I& formula) {
  const pair_flops seen = count_flops(formula);
  if (seen == I::flops) return {};
  std::ostringstream text;
  text << I::name << " declares " << I::flops << "; counted: " << seen;
  return text.str();
}

template <int D, class R, template <int, class> class Smoothing>
void declared_is_counted() {
  const physics water{.H = 0.1, .eos = {}};
  EXPECT_EQ(wrong_declaration(ferrari09<D, R, Smoothing>(water)), "") << D << "D " << Smoothing<D, R>::name;
  EXPECT_EQ(wrong_declaration(monaghan94<D, R, Smoothing>(water)), "") << D << "D " << Smoothing<D, R>::name;
  const Smoothing<D, R> W(0.1);
  EXPECT_EQ(flops_of([&](auto in) { return W.slope_over_r(in()); }), (Smoothing<D, R>::slope_flops))
      << D << "D " << Smoothing<D, R>::name;
}

template <int D, class R>
void declared_is_counted_for_every_kernel() {
  declared_is_counted<D, R, wendland_c2>();
  declared_is_counted<D, R, wendland_c4>();
  declared_is_counted<D, R, wendland_c6>();
  declared_is_counted<D, R, cubic_spline>();
  declared_is_counted<D, R, gaussian>();
  EXPECT_EQ(wrong_declaration(count<D, R>(physics{})), "");
  EXPECT_EQ(count_distance_test<D>(), distance_test_flops(D));
}

TEST(declared_flops, are_those_counted_in_every_dimension) {
  declared_is_counted_for_every_kernel<1, double>();
  declared_is_counted_for_every_kernel<2, double>();
  declared_is_counted_for_every_kernel<3, double>();
  declared_is_counted_for_every_kernel<1, float>();
  declared_is_counted_for_every_kernel<2, float>();
  declared_is_counted_for_every_kernel<3, float>();
}

/// Off by one in one of three numbers.
struct boastful : ferrari09<3, double, wendland_c2> {
  using ferrari09::ferrari09;
  static constexpr pair_flops flops{44, 34, 28};
};

TEST(declared_flops, are_refused_if_they_are_not) {
  EXPECT_EQ(wrong_declaration(boastful(physics{.H = 0.1, .eos = {}})),
            "ferrari09 declares both 44, one-sided 34, boundary 28; counted: both 44, one-sided 33, boundary 28");
}

/// By hand, for the default formula: sqrt 1, F 5, v 3, v.r 5, flux 4, (p_i + p_j) r 4; per side: m F 1, m F (...) 3,
/// m F (p_i + p_j) r 3, sums 4.
TEST(declared_flops, of_the_default_formula_by_hand) {
  using formula = ferrari09<3, double, wendland_c2>;
  EXPECT_EQ(formula::flops.one_sided, 1 + 5 + 3 + 5 + 4 + 4 + 11);
  EXPECT_EQ(formula::flops.both, 1 + 5 + 3 + 5 + 4 + 4 + 2 * 11);
}

/// Every formula of this build, through the door.
TEST(costs, are_told_by_every_reference) {
  const registry& r = registry::instance();
  ASSERT_FALSE(r.formulas().empty());
  for (const auto& [interaction, smoothing, dim, precision] : r.formulas()) {
    SCOPED_TRACE(interaction + "/" + smoothing + "/" + std::to_string(dim) + "D/" + precision);
    setup s;
    s.interaction = interaction;
    s.smoothing = smoothing;
    s.dim = dim;
    s.precision = precision;
    s.constants.H = 0.1;
    s.omega_low.assign(static_cast<std::size_t>(dim), 0);
    s.omega_high.assign(static_cast<std::size_t>(dim), 1);
    const formula_costs c = r.make_reference(s)->costs();
    ASSERT_TRUE(c.declared.has_value());
    EXPECT_EQ(*c.declared, c.counted);
    EXPECT_EQ(c.dim, dim);
    EXPECT_EQ(c.distance_test, 3 * dim);
    const int value = precision == "double" ? 8 : 4, real = precision == "float" ? 4 : 8;
    const int scalars = interaction == "ferrari09" ? dim + 5 : interaction == "monaghan94" ? dim + 4 : 0;
    const bool counts = interaction == "count";
    EXPECT_EQ(c.fluid_bytes, value * (dim + scalars) + (counts ? 8 : 0));
    EXPECT_EQ(c.rates_bytes, counts ? 16 : real * (1 + dim));
    EXPECT_EQ(c.boundary_bytes, real * dim + (counts ? 8 : interaction == "ferrari09" ? real * dim : 0));
  }
}

}  // namespace
}  // namespace pairsum
