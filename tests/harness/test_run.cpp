#include <map>
#include <set>

#include "lying_backends.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

using run_test = study_test;

TEST_F(run_test, writes_every_step_of_every_point_once_and_all_verified) {
  const auto path = folder_ / "rows.jsonl";
  ASSERT_EQ(run(small(), path), 0);
  const rows_file rows = read_rows(path);
  const std::size_t points = 2 * (1 + 2 + 2);
  EXPECT_EQ(rows.samples.size(), points * 2 * 3);
  EXPECT_EQ(rows.environments.size(), 1u);
  std::set<std::string> seen;
  std::map<std::pair<int, int>, std::set<int>> slots;
  for (const sample& s : rows.samples) {
    EXPECT_TRUE(seen.insert(s.point.backend + std::to_string(s.point.M) + std::to_string(s.point.threads) + "r" +
                            std::to_string(s.repetition) + "s" + std::to_string(s.step))
                    .second);
    slots[{s.round, s.repetition}].insert(s.slot);
    ASSERT_TRUE(s.phases);
    EXPECT_TRUE(s.verify.fingerprint);
    EXPECT_FALSE(s.error);
    EXPECT_EQ(s.work.has_value(), s.step == 1);
    double parts = 0;
    for (const auto& m : phase_members)
      if (std::string(m.name) != "total_s") parts += ((*s.phases).*m.value).value();
    EXPECT_NEAR(parts, *s.phases->total_s, 1e-9);
  }
  for (const auto& [repetition, used] : slots) EXPECT_EQ(used.size(), points) << "each slot used once";
}

TEST_F(run_test, equal_bits_over_threads_and_runtimes_are_in_the_rows) {
  const auto path = folder_ / "rows.jsonl";
  ASSERT_EQ(run(small(), path), 0);
  std::map<std::pair<int, int>, std::set<std::string>> bits;
  for (const sample& s : read_rows(path).samples)
    if (s.point.backend.starts_with("symmetric")) bits[{s.point.M, s.step}].insert(*s.verify.fingerprint);
  for (const auto& [at, different] : bits) EXPECT_EQ(different.size(), 1u) << "M=" << at.first << " step " << at.second;
}

TEST_F(run_test, passes_of_parallel_backends_are_timed) {
  const auto path = folder_ / "rows.jsonl";
  ASSERT_EQ(run(small(), path), 0);
  for (const sample& s : read_rows(path).samples) {
    ASSERT_EQ(s.threads_busy_s.has_value(), s.point.backend != "naive") << s.point.backend;
    EXPECT_EQ(s.threads_busy_s.has_value(), s.barrier_wait_s.has_value());
    if (!s.threads_busy_s) continue;
    ASSERT_EQ(s.threads_busy_s->size(), 8u) << "a pass per colour";
    for (const auto& pass : *s.threads_busy_s) EXPECT_EQ(pass.size(), static_cast<std::size_t>(s.point.threads));
  }
}

TEST_F(run_test, work_says_how_many_tests_folding_adds) {
  const auto path = folder_ / "rows.jsonl";
  ASSERT_EQ(run(small(), path), 0);
  std::set<std::uint64_t> symmetric;
  for (const sample& s : read_rows(path).samples) {
    if (!s.work) continue;
    ASSERT_TRUE(s.work->pairs_tested_unfolded);
    EXPECT_LE(*s.work->pairs_tested_unfolded, s.work->pairs_tested);
    if (s.point.backend != "naive") symmetric.insert(*s.work->pairs_tested_unfolded);
  }
  EXPECT_EQ(symmetric.size(), 1u) << "the same whatever M";
}

TEST_F(run_test, rows_of_vector_backends_say_how_full_their_vectors_were) {
  const auto path = folder_ / "rows.jsonl";
  run_request r = small();
  r.backends = {"naive", "tiles_omp", "naive_tiles_omp"};
  ASSERT_EQ(run(r, path), 0);
  std::size_t seen = 0;
  for (const sample& s : read_rows(path).samples) {
    if (!s.work) continue;
    ASSERT_EQ(s.work->vector_units.has_value(), s.point.backend != "naive");
    if (!s.work->vector_units) continue;
    ++seen;
    const vector_use& v = *s.work->vector_units;
    const double sides = s.point.backend == "tiles_omp" ? 1 : 2;
    EXPECT_GT(s.work->pairs_fluid_boundary, 0u);
    EXPECT_EQ(v.occupancy,
              sides * static_cast<double>(s.work->pairs_fluid_fluid) / static_cast<double>(v.lanes * v.vectors));
    EXPECT_LE(v.occupancy, 1);
    EXPECT_NE(v.block, "auto");
  }
  EXPECT_GT(seen, 0u);
}

TEST_F(run_test, a_second_run_into_the_same_file_is_the_next_round) {
  const auto path = folder_ / "rows.jsonl";
  run_request r = small();
  r.backends = {"naive"};
  ASSERT_EQ(run(r, path), 0);
  ASSERT_EQ(run(r, path), 0);
  std::set<int> rounds;
  for (const sample& s : read_rows(path).samples) rounds.insert(s.round);
  EXPECT_EQ(rounds, (std::set<int>{1, 2}));
}

TEST_F(run_test, a_wrong_backend_gets_an_error_row_and_never_a_time) {
  const registry broken = broken_registry();
  const auto path = folder_ / "rows.jsonl";
  run_request r = small();
  r.backends = {"broken_none", "broken_drop_pair"};
  r.threads = {1};
  EXPECT_EQ(run(r, path, broken), 1);
  std::size_t good = 0, failed = 0;
  for (const sample& s : read_rows(path).samples) {
    if (s.point.backend == "broken_drop_pair") {
      EXPECT_TRUE(s.error);
      EXPECT_FALSE(s.phases);
      ++failed;
    } else {
      EXPECT_TRUE(s.phases);
      ++good;
    }
  }
  EXPECT_EQ(failed, 2u * 2);  // one per M and repetition
  EXPECT_EQ(good, 2u * 2 * 3);
}

TEST_F(run_test, every_stage_of_a_step_is_verified) {
  const registry lying = lying_registry();
  run_request r = small();
  r.backends = {"wrong_in_third_sum"};
  r.M = {3};
  for (const auto& [integrator, step] : {std::pair{"rk2", 2}, {"predictor_corrector", 2}, {"rk4", 1}, {"euler", 3}}) {
    const auto path = folder_ / (std::string(integrator) + ".jsonl");
    r.integrators = {integrator};
    EXPECT_EQ(run(r, path, lying), 1) << integrator;
    const rows_file rows = read_rows(path);
    ASSERT_EQ(rows.samples.size(), 2u) << "one per repetition";
    ASSERT_TRUE(rows.samples[0].error);
    EXPECT_EQ(rows.samples[0].error->find("step " + std::to_string(step) + ":"), 0u) << *rows.samples[0].error;
  }
  r.integrators = {"rk2"};
  r.steps = 1;  // two sums, both right
  EXPECT_EQ(run(r, folder_ / "right.jsonl", lying), 0);
}

TEST_F(run_test, orders_of_memory_give_the_same_pairs) {
  std::set<std::uint64_t> pairs;
  for (const char* order : {"lattice", "shuffled", "morton"}) {
    const auto path = folder_ / (std::string(order) + ".jsonl");
    run_request r = small();
    r.backends = {"symmetric"};
    r.orders = {order};
    ASSERT_EQ(run(r, path), 0) << order;
    for (const sample& s : read_rows(path).samples)
      if (s.work) pairs.insert(s.work->pairs_interacting);
  }
  EXPECT_EQ(pairs.size(), 1u);
}

TEST_F(run_test, a_budget_ends_after_one_round_at_least) {
  const auto path = folder_ / "rows.jsonl";
  study_plan plan = plan_of(small(), 1000000);
  plan.budget_s = 0.001;
  ASSERT_EQ(run(plan, path), 0);
  const rows_file rows = read_rows(path);
  EXPECT_EQ(rows.finished_rounds().size(), 1u);
  ASSERT_EQ(rows.ends.size(), 1u);
  EXPECT_NE(rows.ends[0].reason.find("budget"), std::string::npos);
}

}  // namespace
}  // namespace pairsum::harness
