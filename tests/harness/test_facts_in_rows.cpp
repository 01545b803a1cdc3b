#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include <pairsum/cases/case.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "cut_studies.hpp"
#include "harness/environment/machine.hpp"
#include "harness/model/cost.hpp"
#include "harness/self_test/entries.hpp"

// What rows say so that nobody has to ask the build that wrote them, and what it costs to read them.
namespace pairsum::harness {
namespace {

using facts_in_rows = study_test;

std::vector<std::string> names_of(const std::vector<backend_row>& rows) {
  std::vector<std::string> names;
  for (const backend_row& b : rows) names.push_back(b.name);
  return names;
}

TEST_F(facts_in_rows, each_backend_is_described_once_before_its_samples) {
  const study_plan plan = plan_of(small(), 2);
  ASSERT_EQ(run(plan, path_), 0);
  const rows_file rows = read_rows(path_);  // which refuses samples before their backend's row
  EXPECT_EQ(names_of(rows.backends), small().backends);
  for (const backend_row& b : rows.backends) {
    const backend_traits& t = registry::instance().find_backend(b.name).traits;
    EXPECT_EQ(b.study, plan.study);
    EXPECT_EQ(b.environment, rows.environments.front().environment);
    EXPECT_EQ(b.description, t.description);
    EXPECT_EQ(b.aliases, t.aliases);
    EXPECT_EQ(b.runtime, name_of(t.threads));
    EXPECT_EQ(b.conflicts, name_of(t.conflicts));
    EXPECT_EQ(std::tie(b.symmetric, b.deterministic, b.vector, b.blocks),
              std::tie(t.symmetric, t.deterministic, t.vector, t.blocks));
    EXPECT_FALSE(b.self_test);
  }
  run_request more = small();
  more.backends = {"naive", "symmetric"};
  ASSERT_EQ(run(more, path_), 0);
  EXPECT_EQ(names_of(read_rows(path_).backends),
            (std::vector<std::string>{"naive", "symmetric_omp", "symmetric_tbb", "symmetric"}));
}

TEST_F(facts_in_rows, copies_that_test_the_harness_name_their_base) {
  study_plan plan = study_of({small_part("a", 1)});
  plan.parts[0].request.backends = {"slowed_5_naive_omp", "corrupt_naive_omp"};
  plan.self_test = true;
  ASSERT_EQ(conduct_here(plan, path_, registry_of(plan)), 0);
  const rows_file rows = read_rows(path_);
  ASSERT_EQ(rows.backends.size(), 2u);
  EXPECT_EQ(rows.backends[0].self_test, (self_test_row{"slowed 5 %", "naive_omp", 1.05}));
  EXPECT_EQ(rows.backends[1].self_test, (self_test_row{"corrupt", "naive_omp", std::nullopt}));
}

TEST_F(facts_in_rows, work_says_what_a_sum_needs_at_least) {
  run_request r = small();
  r.M = {6};
  ASSERT_EQ(run(r, path_), 0);
  const initial_condition initial = make_case("dam_break", {3, 0.08, 0, "perturbed", 1});
  setup s = setup_of(initial);
  std::tie(s.interaction, s.smoothing, s.precision) = std::tuple("ferrari09", "wendland_c2", "double");
  cost_question q;
  q.formula = registry::instance().make_reference(s)->costs();
  for (const auto& [level, bytes] : describe_machine().caches)
    q.last_level_cache_bytes = std::max(q.last_level_cache_bytes, bytes);
  std::map<std::string, double> flops;
  for (const sample& one : read_rows(path_).samples) {
    if (!one.work) continue;
    q.backend = registry::instance().find_backend(one.point.backend).traits;
    q.work = {};
    q.work.pairs_tested = one.work->pairs_tested;
    q.work.pairs_fluid_fluid = one.work->pairs_fluid_fluid;
    q.work.pairs_fluid_boundary = one.work->pairs_fluid_boundary;
    std::tie(q.n_fluid, q.n_boundary) = std::tie(one.point.n_fluid, one.point.n_boundary);
    const cost_bound bound = bound_of(q);
    EXPECT_EQ(one.work->flops, bound.flops) << one.point.backend;
    EXPECT_EQ(one.work->bytes, bound.bytes) << one.point.backend;
    flops[one.point.backend] = bound.flops;
  }
  EXPECT_GT(flops["naive"], flops["symmetric_omp"]);
  EXPECT_EQ(flops["symmetric_tbb"], flops["symmetric_omp"]);
}

TEST_F(facts_in_rows, particles_that_leave_are_counted_in_their_step) {
  run_request r = small();
  r.M = {3};
  r.steps = 4;
  ASSERT_EQ(run(r, path_), 0);
  for (const sample& s : read_rows(path_).samples) EXPECT_EQ(s.lost, 0u);
  r.dt = 0.1;  // so long that they fly out
  r.outside = "drop";
  const auto path = folder_ / "lost.jsonl";
  ASSERT_EQ(run(r, path), 0);
  std::map<int, std::uint64_t> lost;
  for (const sample& s : read_rows(path).samples) {
    const auto at = lost.emplace(s.step, s.lost.value()).first;
    EXPECT_EQ(at->second, s.lost) << "of every backend the same";
  }
  EXPECT_EQ(lost[1], 0u);
  EXPECT_GT(lost[2] + lost[3], 0u);
  const initial_condition initial = make_case("dam_break", {3, 0.08, 0, "perturbed", 1});
  EXPECT_LT(lost[2] + lost[3] + lost[4], initial.particles.count(particle_kind::fluid)) << "each once";
}

TEST_F(facts_in_rows, a_point_whose_particles_leave_gets_an_error_and_no_time) {
  run_request r = small();
  r.M = {3};
  r.steps = 4;
  r.dt = 0.1;
  ASSERT_EQ(run(r, path_), 1);
  const auto samples = read_rows(path_).samples;
  EXPECT_FALSE(samples.empty());
  for (const sample& s : samples) {
    EXPECT_FALSE(s.phases);
    const std::string error = s.error.value_or("");
    EXPECT_TRUE(error.starts_with("step 2: particle ") || error.starts_with("step 3: particle ")) << error;
    EXPECT_NE(error.find("left Omega: dt is too large (0.1 s)"), std::string::npos) << error;
  }
}

TEST_F(facts_in_rows, a_state_that_is_no_longer_finite_is_named) {
  run_request r = small();
  r.case_name = "periodic_lattice";
  r.dx = {0.1};
  r.backends = {"naive"};
  r.M = {2};
  r.threads = {1};
  r.steps = 50;
  for (const char* integrator : {"euler", "rk2", "rk4"})
    for (const double dt : {0.02, 1e308}) {  // the formula overflows, and the state does
      r.integrators = {integrator};
      r.dt = dt;
      const auto path = folder_ / fmt::format("{}_{}.jsonl", integrator, dt);
      ASSERT_EQ(run(r, path), 1);
      for (const sample& s : read_rows(path).samples) {
        const std::string error = s.error.value_or("");
        EXPECT_TRUE(error.starts_with("step ")) << error;
        EXPECT_NE(error.find(" of particle "), std::string::npos) << error;
        EXPECT_NE(error.find("is not finite"), std::string::npos) << error;
        EXPECT_NE(error.find(fmt::format(": dt is too large ({:g} s)", dt)), std::string::npos) << error;
        EXPECT_EQ(error.find("nan"), std::string::npos) << error;
      }
    }
}

TEST_F(facts_in_rows, threads_that_worked_are_counted) {
  ASSERT_EQ(run(small(), path_), 0);
  for (const sample& s : read_rows(path_).samples) {
    ASSERT_TRUE(s.threads_worked);
    EXPECT_GE(*s.threads_worked, 1u);
    EXPECT_LE(*s.threads_worked, static_cast<std::uint64_t>(s.point.threads));
  }
}

/// How many bytes are read while a study of so many rounds is measured, and how many its file has in the end.
std::pair<std::uint64_t, std::uint64_t> read_and_written(const std::filesystem::path& path, int rounds) {
  const std::uint64_t before = bytes_of_rows_read();
  EXPECT_EQ(conduct_here(study_of({small_part("a", rounds)}), path), 0);
  return {bytes_of_rows_read() - before, std::filesystem::file_size(path)};
}

TEST_F(facts_in_rows, a_study_reads_each_row_of_its_file_once) {
  const auto [read, written] = read_and_written(path_, 12);
  EXPECT_LE(read, written);
  EXPECT_GT(read, written * 9 / 10) << "not counted";
  const auto [read_again, size] = read_and_written(path_, 12);
  EXPECT_LE(read_again, size) << "what was there before once, too";
  EXPECT_GT(read_again, written);
}

TEST_F(facts_in_rows, with_several_builds_too) {
  study_plan plan = study_of({small_part("a", 12)});
  plan.builds = 2;
  const std::uint64_t before = bytes_of_rows_read();
  const launcher here = in_this_process(registry::instance());
  ASSERT_EQ(conduct_here(plan, path_, registry::instance(), {here, here}), 0);
  EXPECT_LE(bytes_of_rows_read() - before, std::filesystem::file_size(path_));
  const rows_file rows = read_rows(path_);
  EXPECT_EQ(rows.environments.size(), 1u);
  EXPECT_EQ(rows.backends.size(), 1u);
}

class resume_of_schema_2 : public cut_study {
 protected:
  /// The rows of the study so far as schema 2 wrote them.
  void make_former() const {
    std::istringstream lines(text_of(path_));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      nlohmann::json j = nlohmann::json::parse(line);
      if (j.at("kind") == "backend") continue;
      j["schema"] = former_row_schema;
      if (j.at("kind") == "sample") {
        for (const char* key : {"lost", "threads_worked"}) j.erase(key);
        if (j.at("work").is_object())
          for (const char* key : {"flops", "bytes"}) j["work"].erase(key);
      }
      text += j.dump() + "\n";
    }
    write_text(path_, text);
  }
};

TEST_F(resume_of_schema_2, is_refused_and_nothing_is_appended) {
  path_ = folder_ / "test" / "a.jsonl";
  kill_in_round(2);
  make_former();
  ASSERT_NO_THROW(read_rows(path_));
  expect_refused("holds rows of pairsum.row/2, this program writes pairsum.row/3. Name another file");
  plan_.builds = 2;
  expect_refused("holds rows of pairsum.row/2");
  EXPECT_NE(rows_path(folder_, plan_, false, "none"), path_) << "nor is it found to be resumed";
}

}  // namespace
}  // namespace pairsum::harness
