#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "broken_registry.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/self_test/self_test.hpp"
#include "harness/self_test/slowed_summation.hpp"
#include "harness/verify/verifier.hpp"
#include "harness/verify/verify_all.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

initial_condition small() { return make_case("dam_break", {.dx = 0.08, .H = 0, .state = "perturbed", .seed = 1}); }

bool has(const registry& r, std::string_view name) {
  return std::ranges::any_of(r.backends(),
                             [&](const backend_entry& b) { return b.traits.name == name && b.unavailable.empty(); });
}

/// The entries whose bases this build has.
std::vector<self_test_entry> built() {
  std::vector<self_test_entry> found;
  for (const self_test_entry& e : self_test_entries())
    if (has(registry::instance(), e.base)) found.push_back(e);
  return found;
}

std::unique_ptr<summation> summed(const registry& r, std::string_view backend, const initial_condition& c) {
  setup s = setup_of(c);
  s.backend = backend;
  auto sum = r.make_summation(s);
  const worker_team workers(sum->traits().threads, 2);
  sum->load(c.particles, {});
  sum->evaluate(workers.get());
  return sum;
}

/// A backend of which the tests know when it began and ended.
class timed_summation final : public forwarding_summation {
 public:
  timed_summation(std::unique_ptr<summation> inner, double& took)
      : forwarding_summation(std::move(inner), "timed", "for tests"), took_(took) {}
  void sum(const team& t) override {
    const stopwatch watch;
    forwarding_summation::sum(t);
    took_ = watch.seconds();
  }

 private:
  double& took_;
};

/// A sound serial backend under the name of one that the self-test copies.
backend_entry poses_as_naive_omp() { return backend_entry::of<broken_none>("naive_omp", runtime::serial); }

registry impostor() {
  registry r;
  r.add(test_kit::ferrari09_3d());
  r.add(poses_as_naive_omp());
  return r;
}

TEST(self_test, every_entry_says_what_is_expected_of_it) {
  const std::map<std::string_view, double> expected{
      {"A/A", 1}, {"slowed 5 %", 1.05}, {"slowed 20 %", 1.2}, {"corrupt", 0}};
  std::set<std::string_view> words;
  for (const self_test_entry& e : self_test_entries()) {
    EXPECT_TRUE(words.insert(e.word).second) << e.word;
    EXPECT_TRUE(e.word.ends_with(e.base)) << e.word;
    EXPECT_NE(e.description.find(e.base), std::string_view::npos) << e.word;
    EXPECT_EQ(e.expected_ratio().has_value(), e.kind != self_test_kind::corrupt);
    EXPECT_EQ(e.expected_ratio().value_or(0), expected.at(e.what)) << e.word;
  }
  EXPECT_EQ(words.size(), 8u);
}

TEST(self_test, copies_have_their_own_name_and_all_else_of_the_wrapped) {
  const registry r = with_self_test(registry::instance());
  for (const self_test_entry& e : built()) {
    const backend_traits own = r.find_backend(std::string(e.word)).traits;
    const backend_traits base = r.find_backend(std::string(e.base)).traits;
    setup s = setup_of(small());
    s.backend = e.word;
    for (const backend_traits& t : {own, r.make_summation(s)->traits()}) {
      EXPECT_EQ(t.name, e.word);
      EXPECT_EQ(t.description, e.description);
      EXPECT_EQ(t.aliases, base.aliases);
      EXPECT_EQ(t.threads, base.threads);
      EXPECT_EQ(t.symmetric, base.symmetric);
      EXPECT_EQ(t.deterministic, base.deterministic);
      EXPECT_EQ(t.loop, base.loop);
    }
  }
}

TEST(self_test, rates_are_the_same_bits_but_for_one_of_the_corrupt) {
  const registry r = with_self_test(registry::instance());
  const initial_condition c = small();
  for (const self_test_entry& e : built()) {
    const auto own = summed(r, e.word, c), base = summed(r, e.base, c);
    const rate_table rates = own->rates(), right = base->rates();
    int different = 0;
    for (std::size_t k = 0; k < right.columns.size(); ++k)
      for (std::size_t id = 0; id < right.columns[k].size(); ++id)
        different += rates.columns[k][id] != right.columns[k][id];
    EXPECT_EQ(different, e.kind == self_test_kind::corrupt ? 1 : 0) << e.word;
    EXPECT_EQ(own->fingerprint() != base->fingerprint(), e.kind == self_test_kind::corrupt) << e.word;
    EXPECT_EQ(own->count_work().pairs_interacting(), base->count_work().pairs_interacting()) << e.word;
  }
}

/// The wrapper's clock runs from before the inner sum to after it, so this holds however the machine is disturbed.
TEST(self_test, the_delay_is_at_least_its_share) {
  const initial_condition c = small();
  for (const double share : {0.05, 0.2, 1.0}) {
    setup s = setup_of(c);
    s.backend = "naive_omp";
    double took = 0;
    slowed_summation slowed(std::make_unique<timed_summation>(impostor().make_summation(s), took), "slowed", "", share);
    slowed.load(c.particles, {});
    slowed.index(team());
    slowed.prepare(team());
    slowed.zero(team());
    const stopwatch watch;
    slowed.sum(team());
    const double all = watch.seconds();
    EXPECT_GT(took, 0);
    EXPECT_GE(all, took * (1 + share) * (1 - 1e-12));
  }
}

TEST(self_test, the_verifier_refuses_the_corrupt_alone) {
  const registry r = with_self_test(registry::instance());
  run_request plan;
  plan.backends.clear();
  plan.interactions = {"ferrari09", "count"};
  plan.M = {2, 6};
  plan.threads = {1, 2};
  for (const self_test_entry& e : built()) plan.backends.emplace_back(e.word);
  std::size_t lines = 0;
  verify_all(r, small(), verify_plan_of(plan, r), [&](const verify_line& l) {
    ++lines;
    EXPECT_EQ(l.ok, !l.sum.backend.starts_with("corrupt_"))
        << l.sum.backend << " " << l.sum.interaction << ": " << l.error;
    EXPECT_EQ(l.error.find("(1 of ") != std::string::npos, !l.ok) << l.error;
  });
  EXPECT_EQ(lines, 8 * plan.backends.size());
}

TEST(self_test, the_corrupt_is_wrong_where_all_rates_are_zero) {
  particle_table alone = small().particles;
  alone.resize(1);
  ASSERT_EQ(alone.kind[0], particle_kind::fluid);
  const registry r = with_self_test(registry::instance());
  for (const self_test_entry& e : built()) {
    setup s = setup_of(small());
    s.interaction = "count";
    s.backend = e.word;
    const auto sum = r.make_summation(s);
    sum->load(alone, {});
    sum->evaluate(team::omp(1));
    verifier oracle(r, s, alone, team::omp(1));
    EXPECT_EQ(oracle.check(*sum, {}, team::omp(1)).ok, e.kind != self_test_kind::corrupt) << e.word;
  }
}

TEST(self_test, an_integrator_moves_the_particles_of_a_copy) {
  const registry r = with_self_test(registry::instance());
  const initial_condition c = small();
  for (const self_test_entry& e : built()) {
    const auto moved = [&](std::string_view backend) {
      const auto sum = summed(r, backend, c);
      const worker_team workers(sum->traits().threads, 2);
      find_integrator("rk2").step(
          *sum, 1e-4, 9.81, [&] { sum->evaluate(workers.get()); }, workers.get());
      return sum->snapshot();
    };
    const particle_table own = moved(e.word), base = moved(e.base);
    EXPECT_EQ(own.x[1], base.x[1]) << e.word;
    EXPECT_NE(own.x[1], c.particles.x[1]) << e.word;
  }
}

using self_test_run = study_test;

TEST_F(self_test_run, measures_the_sound_copies_and_fails_the_corrupt) {
  run_request request;
  request.dx = {0.08};
  request.states = {"perturbed"};
  request.integrators = {"rk2"};
  request.M = {3};
  request.threads = {1};
  request.steps = 2;
  request.repetitions = 1;
  request.backends.clear();
  for (const self_test_entry& e : built()) request.backends.push_back(std::string(e.word));
  if (request.backends.empty()) GTEST_SKIP() << "neither symmetric_omp nor naive_omp is in this build";
  EXPECT_EQ(run(request, path_, with_self_test(registry::instance())), 1);
  for (const sample& s : read_rows(path_).samples)
    EXPECT_EQ(s.error.has_value(), s.point.backend.starts_with("corrupt_")) << s.point.backend;
}

TEST(self_test, bases_that_were_not_built_are_left_out) {
  const registry none = with_self_test(broken_registry());
  EXPECT_EQ(none.backends().size(), broken_registry().backends().size());
  registry restricted = broken_registry();
  backend_entry left_out = poses_as_naive_omp();
  left_out.unavailable = "not in this build";
  restricted.add(left_out);
  EXPECT_EQ(with_self_test(restricted).backends().size(), restricted.backends().size());
  const registry one = with_self_test(impostor());
  EXPECT_EQ(one.backends().size(), 1 + self_test_entries().size() / 2);
  EXPECT_FALSE(has(one, "again_symmetric_omp"));
  EXPECT_NO_THROW(summed(one, "again_naive_omp", small())) << "wraps what the given registry has";
  setup s = setup_of(small());
  s.backend = "again_naive_omp";
  EXPECT_EQ(one.make_summation(s)->traits().threads, runtime::serial);
  s.backend = "again_symmetric_omp";
  EXPECT_THROW(one.make_summation(s), error);
}

TEST(self_test, the_given_registry_stays_as_it_is) {
  const std::size_t before = registry::instance().backends().size();
  const registry r = with_self_test(registry::instance());
  EXPECT_EQ(registry::instance().backends().size(), before);
  EXPECT_EQ(r.backends().size(), before + built().size());
}

TEST(registry, a_wrapper_needs_a_base_that_is_none_and_a_name_of_its_own) {
  const auto wrap = [](std::unique_ptr<summation> s, const setup&) { return s; };
  backend_traits t = poses_as_naive_omp().traits;
  registry r = impostor();
  EXPECT_THROW(r.add_wrapper(t, "naive_omp", wrap), error);
  t.name = "another";
  EXPECT_THROW(r.add_wrapper(t, "nope", wrap), error);
  r.add_wrapper(t, "naive_omp", wrap);
  t.name = "a_third";
  EXPECT_THROW(r.add_wrapper(t, "another", wrap), error);
  EXPECT_FALSE(has(r, "a_third"));
  EXPECT_THROW(with_self_test(with_self_test(impostor())), error);
}

}  // namespace
}  // namespace pairsum::harness
