#include <gtest/gtest.h>

#include <limits>

#include <pairsum/core/error.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/run/point_setup.hpp"
#include "harness/verify/pack.hpp"
#include "harness/verify/shared_store.hpp"
#include "harness/verify/verifier.hpp"
#include "harness/verify/verify_all.hpp"
#include "lying_backends.hpp"

namespace pairsum::harness {
namespace {

run_request plan_for(std::vector<std::string> backends) {
  run_request r;
  r.interactions = {"ferrari09", "count"};
  r.backends = std::move(backends);
  r.M = {2, 6};
  r.threads = {1, 2};
  return r;
}

std::vector<verify_line> verify(const registry& r, const run_request& plan, const initial_condition& c, bool& ok) {
  std::vector<verify_line> lines;
  ok = verify_all(r, c, verify_plan_of(plan, r), [&](const verify_line& l) { lines.push_back(l); });
  return lines;
}

initial_condition perturbed() { return make_case("dam_break", {.dx = 0.08, .H = 0, .state = "perturbed", .seed = 1}); }

TEST(verify, passes_every_real_backend) {
  std::vector<std::string> names;
  for (const auto& b : registry::instance().backends()) names.emplace_back(b.traits.name);
  bool ok = false;
  const auto lines = verify(registry::instance(), plan_for(names), perturbed(), ok);
  EXPECT_TRUE(ok);
  const run_request plan = plan_for(names);
  std::size_t sums = 0;  // serial backends once, the others with each number of threads
  for (const auto& b : registry::instance().backends())
    sums += b.traits.threads == runtime::serial ? 1 : plan.threads.size();
  EXPECT_GT(sums, names.size());
  EXPECT_EQ(lines.size(), plan.interactions.size() * plan.M.size() * sums);
  for (const auto& l : lines) {
    EXPECT_TRUE(l.ok) << l.sum.backend << ": " << l.error;
    EXPECT_LE(l.share, 1);
  }
}

TEST(verify, catches_a_dropped_a_doubled_and_a_sign_swapped_pair) {
  const registry broken = broken_registry();
  for (const fault f : {fault::drop_pair, fault::double_pair, fault::flip_sign}) {
    bool ok = true;
    const auto lines = verify(broken, plan_for({std::string(name_of(f))}), perturbed(), ok);
    EXPECT_FALSE(ok) << name_of(f);
    for (const auto& l : lines) {
      EXPECT_FALSE(l.ok) << l.sum.backend << " with " << l.sum.interaction << " M=" << l.sum.M;
      EXPECT_NE(l.error.find("of particle"), std::string::npos) << l.error;
    }
  }
}

TEST(verify, passes_the_same_test_backend_without_a_fault) {
  bool ok = false;
  verify(broken_registry(), plan_for({"broken_none"}), perturbed(), ok);
  EXPECT_TRUE(ok);
}

TEST(verify, catches_a_backend_that_counts_one_pair_too_many) {
  run_request plan = plan_for({"counts_one_too_many"});
  plan.interactions = {"ferrari09"};
  bool ok = true;
  const auto lines = verify(lying_registry(), plan, perturbed(), ok);
  EXPECT_FALSE(ok);
  ASSERT_EQ(lines.size(), plan.M.size());
  for (const auto& l : lines) {
    EXPECT_FALSE(l.ok);
    EXPECT_NE(l.error.find("fluid-fluid"), std::string::npos) << l.error;
    EXPECT_LE(l.share, 1) << "its rates are right";
  }
}

TEST(verify, catches_a_backend_whose_bits_change_with_the_threads_though_it_claims_they_do_not) {
  run_request plan = plan_for({"claims_equal_bits"});
  plan.interactions = {"ferrari09"};
  bool ok = true;
  const auto lines = verify(lying_registry(), plan, perturbed(), ok);
  EXPECT_FALSE(ok);
  ASSERT_EQ(lines.size(), plan.M.size() * plan.threads.size());
  for (const auto& l : lines) {
    EXPECT_EQ(l.ok, l.threads == 1) << l.error;
    EXPECT_EQ(l.error.find("claims equal bits") != std::string::npos, l.threads != 1) << l.error;
    EXPECT_LE(l.share, 1) << "within its bounds all the same";
  }
  plan.backends = {"admits_other_bits"};
  verify(lying_registry(), plan, perturbed(), ok);
  EXPECT_TRUE(ok) << "the same bits, without the claim";
}

TEST(verify, an_unknown_backend_is_an_error_before_anything_is_summed) {
  bool ok = false;
  EXPECT_THROW(verify(registry::instance(), plan_for({"naive", "nope"}), perturbed(), ok), error);
}

TEST(verifier, known_bits_need_no_second_look_but_other_bits_do) {
  const initial_condition c = perturbed();
  setup s;
  s.omega_low = c.omega_low;
  s.omega_high = c.omega_high;
  s.constants = {c.H, c.eos};
  const registry broken = broken_registry();
  verifier v(broken, s, c.particles, team());
  const auto outcome = [&](const char* backend) {
    s.backend = backend;
    const auto sum = broken.make_summation(s);
    sum->load(c.particles, {});
    sum->evaluate(team());
    return v.check(*sum, {}, team());
  };
  EXPECT_FALSE(outcome("broken_none").known);
  EXPECT_TRUE(outcome("broken_none").known) << "second time: recognised by its bits";
  EXPECT_FALSE(outcome("broken_double_pair").ok);
  EXPECT_FALSE(outcome("broken_double_pair").ok) << "wrong bits are never remembered as right";
}

TEST(verifier, what_one_process_verified_another_knows_by_its_bits) {
  const initial_condition c = perturbed();
  setup s;
  s.omega_low = c.omega_low;
  s.omega_high = c.omega_high;
  s.constants = {c.H, c.eos};
  const registry broken = broken_registry();
  shared_store store;
  const auto outcome = [&](verifier& v, const char* backend) {
    s.backend = backend;
    const auto sum = broken.make_summation(s);
    sum->load(c.particles, {});
    sum->evaluate(team());
    return v.check(*sum, {}, team());
  };
  verifier first(broken, s, c.particles, team(), &store, "key");
  EXPECT_FALSE(outcome(first, "broken_none").known);
  EXPECT_FALSE(outcome(first, "broken_double_pair").ok);
  first.remember();
  shared_store handed(store.descriptor());
  verifier second(broken, s, c.particles, team(), &handed, "key");
  EXPECT_TRUE(outcome(second, "broken_none").known);
  EXPECT_FALSE(outcome(second, "broken_double_pair").known) << "wrong bits are not handed on";
  EXPECT_FALSE(outcome(second, "broken_double_pair").ok);
  EXPECT_EQ(second.initial_expectation().value, first.initial_expectation().value);
  verifier other(broken, s, c.particles, team(), &handed, "another key");
  EXPECT_FALSE(outcome(other, "broken_none").known) << "of another build, case or formula";
}

TEST(verifier, verdicts_without_their_reference_are_an_error_where_it_is_needed) {
  const initial_condition c = perturbed();
  const registry broken = broken_registry();
  shared_store store;
  store.save("key/verdicts", pack(verdict_map{}));
  verifier v(broken, setup_of(c), c.particles, team(), &store, "key");
  EXPECT_THROW(v.initial_expectation(), error);
}

TEST(verifier, rejects_a_reference_whose_cell_search_contradicts_its_brute_force) {
  const initial_condition c = make_case("dam_break", {.dx = 0.03, .H = 0, .state = "perturbed", .seed = 1});
  ASSERT_GT(c.particles.size(), verifier::brute_force_limit);
  setup s;
  s.omega_low = c.omega_low;
  s.omega_high = c.omega_high;
  s.constants = {c.H, c.eos};
  const auto make = [&](double off) { verifier(registry_with_reference_off_by(off), s, c.particles, team::omp(2)); };
  EXPECT_NO_THROW(make(0));
  for (const double off : {2.0, -2.0, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      make(off);
      ADD_FAILURE() << "accepted a cell search that is off by " << off << " bounds";
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find("contradicts brute force"), std::string::npos) << e.what();
    }
  }
}

TEST(verifier, a_later_step_is_checked_against_its_own_state) {
  const initial_condition c = perturbed();
  setup s;
  s.omega_low = c.omega_low;
  s.omega_high = c.omega_high;
  s.constants = {c.H, c.eos};
  verifier v(registry::instance(), s, c.particles, team());
  const auto sum = registry::instance().make_summation(s);
  initial_condition moved = c;
  for (std::size_t i = 0; i < moved.particles.size(); ++i)
    if (moved.particles.kind[i] == particle_kind::fluid) moved.particles.x[0][i] += 1e-3;
  sum->load(moved.particles, {});
  sum->evaluate(team());
  EXPECT_FALSE(v.check(*sum, {}, team()).ok) << "not the initial state";
  EXPECT_TRUE(v.check(*sum, {"euler", 2}, team()).ok) << "right for the state it has";
}

}  // namespace
}  // namespace pairsum::harness
