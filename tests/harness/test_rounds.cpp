#include <algorithm>
#include <map>
#include <set>

#include "harness/environment/environment.hpp"
#include "harness/rows/writer.hpp"
#include "harness/run/worker.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

using rounds = study_test;

TEST_F(rounds, are_closed_by_a_row_each_and_the_study_by_one) {
  const study_plan plan = study_of({small_part("a", 2), small_part("b", 3)});
  ASSERT_EQ(conduct_here(plan, path_), 0);
  const rows_file rows = read_rows(path_);
  std::map<std::string, std::vector<int>> replicates;
  for (const round_row& r : rows.rounds) {
    replicates[r.part].push_back(r.replicate);
    EXPECT_EQ(r.rows, 2u);
    EXPECT_EQ(r.plan, plan_hash(plan));
    EXPECT_EQ(r.seed, 1u);
  }
  EXPECT_EQ(replicates, (std::map<std::string, std::vector<int>>{{"a", {1, 2}}, {"b", {1, 2, 3}}}));
  ASSERT_EQ(rows.ends.size(), 1u);
  EXPECT_EQ(rows.ends[0].plan, plan_hash(plan));
  EXPECT_EQ(rows.valid_samples().size(), rows.samples.size());
}

TEST_F(rounds, a_part_for_which_the_budget_is_used_up_is_left_out_and_said) {
  study_plan plan = study_of({small_part("first", 1000), small_part("second", 1000)});
  plan.budget_s = 0.001;
  ASSERT_EQ(conduct_here(plan, path_), 0);
  const rows_file rows = read_rows(path_);
  ASSERT_EQ(rows.rounds.size(), 1u);
  EXPECT_EQ(rows.rounds[0].part, "first");
  ASSERT_EQ(rows.ends.size(), 1u);
  EXPECT_NE(rows.ends[0].reason.find("before every part was measured"), std::string::npos) << rows.ends[0].reason;
}

TEST_F(rounds, of_a_self_test_are_right_if_the_corrupt_are_refused) {
  study_plan plan = study_of({small_part("a", 1)});
  plan.parts[0].request.backends = {"symmetric_omp", "corrupt_symmetric_omp"};
  plan.self_test = true;
  EXPECT_EQ(conduct_here(plan, path_, registry_of(plan)), 0);
  const rows_file rows = read_rows(path_);
  EXPECT_TRUE(std::ranges::any_of(rows.samples, [](const sample& s) { return s.error.has_value(); }));
}

TEST_F(rounds, two_builds_measure_in_every_round_in_an_order_that_the_seed_decides) {
  study_plan plan = study_of({small_part("a", 12)});
  plan.builds = 2;
  std::map<int, std::string> measured;
  const auto build = [&](const std::string& name) {
    return [&, name](const order& o) {
      if (o.what == errand::measure) measured[o.round] += name;
      return in_this_process(registry::instance())(o);
    };
  };
  ASSERT_EQ(conduct_here(plan, path_, registry::instance(), {build("A"), build("B")}), 0);
  const auto first = measured;
  ASSERT_EQ(first.size(), 12u);
  EXPECT_TRUE(std::ranges::all_of(first, [](const auto& m) { return m.second == "AB" || m.second == "BA"; }));
  EXPECT_TRUE(std::ranges::any_of(first, [](const auto& m) { return m.second == "AB"; }));
  EXPECT_TRUE(std::ranges::any_of(first, [](const auto& m) { return m.second == "BA"; }));
  for (const round_row& r : read_rows(path_).rounds) EXPECT_EQ(r.rows, 2u * 2);
  measured.clear();
  ASSERT_EQ(conduct_here(plan, folder_ / "again.jsonl", registry::instance(), {build("A"), build("B")}), 0);
  EXPECT_EQ(measured, first);
}

TEST_F(rounds, a_build_that_is_cut_voids_the_round_of_both) {
  study_plan plan = study_of({small_part("a", 2)});
  plan.builds = 2;
  int calls = 0;
  const launcher sound = in_this_process(registry::instance());
  const launcher cut_once = [&](const order& o) {
    const departure end = sound(o);
    return o.what == errand::measure && ++calls == 1 ? departure{0, 9, 0} : end;
  };
  ASSERT_EQ(conduct_here(plan, path_, registry::instance(), {sound, cut_once}), 0);
  const rows_file rows = read_rows(path_);
  EXPECT_EQ(rows.voids.size(), 1u);
  ASSERT_EQ(rows.finished_rounds().size(), 2u);
  for (const round_row& r : rows.finished_rounds()) EXPECT_EQ(r.rows, 4u);
}

TEST_F(rounds, a_build_that_measures_nothing_ends_the_study) {
  study_plan plan = study_of({small_part("a", 2)});
  plan.builds = 2;
  const launcher idle = [](const order&) { return departure{.done = true}; };
  EXPECT_EQ(conduct_here(plan, path_, registry::instance(), {in_this_process(registry::instance()), idle}), 2);
  const rows_file rows = read_rows(path_);
  EXPECT_TRUE(rows.rounds.empty());
  EXPECT_TRUE(rows.ends.empty());
  EXPECT_TRUE(rows.unfinished_rounds().empty());
}

TEST_F(rounds, narrow_intervals_end_a_part_before_its_most_rounds) {
  study_plan plan = study_of({small_part("wide", 9), small_part("narrow", 30)});
  plan.parts[0].least_rounds = 1;
  plan.parts[0].half_width = 1e-300;
  plan.parts[1].least_rounds = 1;
  plan.parts[1].half_width = 1e300;
  ASSERT_EQ(conduct_here(plan, path_), 0);
  std::map<std::string, int> made;
  for (const round_row& r : read_rows(path_).rounds) ++made[r.part];
  EXPECT_EQ(made["wide"], 9);
  EXPECT_EQ(made["narrow"], 6) << "fewer give no interval";
}

known_names known_in(const std::filesystem::path& path) {
  rows_reader reader(path);
  reader.read_on();
  return reader.known();
}

/// A row as the measurement of peaks writes it.
peak_row peak(const std::string& environment, int threads) {
  return {"test", utc_now(), environment, threads, "double", 1e10, 1e9};
}

class peaks : public study_test {
 protected:
  peaks() {
    plan_.peaks = true;
    plan_.parts[0].request.backends = {"symmetric_omp"};
    plan_.parts[0].request.threads = {1, 2};
  }

  /// Pretends to measure the peaks of these numbers of threads, and ends so.
  launcher pretend(std::vector<int> threads, departure end = {.done = true}) {
    return [this, threads, end](const order& o) {
      if (o.what != errand::peaks) return in_this_process(registry::instance())(o);
      ++asked_;
      row_writer file(o.out);
      for (const int t : threads) file.write(peak(read_rows(o.out).environments.front().environment, t));
      return end;
    };
  }

  int conduct_with(const launcher& l) { return conduct_here(plan_, path_, registry::instance(), {l}); }

  study_plan plan_ = study_of({small_part("a", 1)});
  int asked_ = 0;
};

TEST_F(peaks, are_measured_once_per_file) {
  ASSERT_EQ(conduct_with(pretend({1, 2})), 0);
  ASSERT_EQ(conduct_with(pretend({1, 2})), 0);
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(read_rows(path_).peaks.size(), 2u);
}

/// Each round says what the machine's multiply-adds reached in its midst, on as many threads as its points, be it one
/// number of threads alone; that of a plan without peaks has none.
TEST_F(peaks, each_round_has_its_paces) {
  plan_.parts[0].least_rounds = plan_.parts[0].most_rounds = 2;
  ASSERT_EQ(conduct_with(pretend({1, 2})), 0);
  const rows_file rows = read_rows(path_);
  std::vector<std::pair<int, int>> found;
  for (const pace_row& p : rows.valid_paces()) {
    found.emplace_back(p.round, p.threads);
    EXPECT_EQ(p.precision, "double");
    EXPECT_GT(p.flops_per_s, 1e8);
  }
  std::ranges::sort(found);
  const std::vector<std::pair<int, int>> wanted{{1, 1}, {1, 2}, {2, 1}, {2, 2}};
  EXPECT_EQ(found, wanted);
  std::set<int> slots;
  for (const sample& s : rows.samples) slots.insert(s.slot);
  EXPECT_EQ(slots.size() > 2 || *slots.rbegin() > 2, true) << "paces are measured among the points";
  study_plan alone = plan_;
  alone.parts[0].request.backends = {"naive"};
  const auto serial = path_.parent_path() / "serial.jsonl";
  ASSERT_EQ(conduct_here(alone, serial, registry::instance(), {pretend({1})}), 0);
  std::vector<int> threads;
  for (const pace_row& p : read_rows(serial).valid_paces()) threads.push_back(p.threads);
  EXPECT_EQ(threads, (std::vector{1, 1}));
  plan_.peaks = false;
  const auto other = path_.parent_path() / "without.jsonl";
  ASSERT_EQ(conduct_here(plan_, other), 0);
  EXPECT_TRUE(read_rows(other).paces.empty());
}

TEST_F(peaks, that_were_cut_are_completed) {
  EXPECT_EQ(conduct_with(pretend({1}, {130, 0, 0})), 130);
  ASSERT_EQ(conduct_with(pretend({2})), 0);
  EXPECT_EQ(asked_, 2);
  EXPECT_EQ(read_rows(path_).peaks.size(), 2u);
}

TEST_F(peaks, that_are_there_are_not_measured_by_the_process_either) {
  ASSERT_EQ(conduct_with(pretend({1, 2})), 0);
  order o;
  o.what = errand::peaks;
  o.plan = plan_;
  o.out = path_.string();
  o.known = known_in(path_);
  o.binding = "none";
  ASSERT_EQ(carry_out(o, registry::instance()), 0);
  EXPECT_EQ(read_rows(path_).peaks.size(), 2u);
}

}  // namespace
}  // namespace pairsum::harness
