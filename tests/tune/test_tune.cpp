#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include <pairsum/core/error.hpp>
#include "harness/self_test/forwarding_summation.hpp"
#include "harness/self_test/self_test.hpp"
#include "harness/tune/paired_times.hpp"
#include "harness/tune/profile_json.hpp"
#include "harness/tune/tune_json.hpp"
#include "harness/tune/tune_text.hpp"

namespace pairsum::harness {
namespace {

tune_request small(std::vector<std::string> backends) {
  tune_request r;
  r.levels.dx = {0.06};
  r.levels.states = {"perturbed"};
  r.levels.backends = std::move(backends);
  r.levels.M = {5};
  r.budget_s = 8;
  r.binding = "none";
  return r;
}

const contestant& of(const tune_result& result, const std::string& backend) {
  const auto at = std::ranges::find(result.points, backend, &point::backend);
  return result.candidates.at(static_cast<std::size_t>(at - result.points.begin()));
}

/// Notes its loads and sums: "l", "s".
struct noting_summation final : forwarding_summation {
  using forwarding_summation::forwarding_summation;
  static inline std::string calls;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) override {
    calls += "l";
    forwarding_summation::load(p, order, t);
  }
  void sum(const team& t) override {
    calls += "s";
    forwarding_summation::sum(t);
  }
};

TEST(tune, times_groups_of_steps_from_particles_loaded_anew) {
  registry all = registry::instance();
  const auto naive = std::ranges::find(all.backends(), "naive", [](const auto& b) { return b.traits.name; });
  backend_traits traits = naive->traits;
  traits.name = "noting";
  all.add_wrapper(traits, "naive", [](std::unique_ptr<summation> inner, const setup&) -> std::unique_ptr<summation> {
    noting_summation::calls += "new ";
    return std::make_unique<noting_summation>(std::move(inner), "noting", "");
  });
  tune_request r = small({"noting"});
  r.budget_s = 2;
  noting_summation::calls.clear();
  tune(r, all);
  EXPECT_TRUE(std::regex_search(noting_summation::calls, std::regex("new ls(lsssss)+new "))) << noting_summation::calls;
  EXPECT_FALSE(std::regex_search(noting_summation::calls, std::regex("s{6}"))) << noting_summation::calls;
}

TEST(tune, a_backend_slowed_by_a_fifth_does_not_win_and_a_corrupt_one_gets_no_time) {
  const registry all = with_self_test(registry::instance());
  const tune_request r =
      small({"slowed_20_naive_omp", "naive_omp", "slowed_20_symmetric_omp", "symmetric_omp", "corrupt_symmetric_omp"});
  const tune_result result = tune(r, all);
  ASSERT_TRUE(result.winner.has_value());
  const std::string winner = result.points[*result.winner].backend;
  EXPECT_TRUE(winner == "symmetric_omp" || winner == "naive_omp") << winner;
  EXPECT_EQ(of(result, "corrupt_symmetric_omp").what, fate::wrong);
  EXPECT_FALSE(of(result, "corrupt_symmetric_omp").look_s.has_value());
  const std::string text = tune_text(r, result, all);
  EXPECT_NE(text.find("take " + winner + " M=5 threads=1 double\n"), text.npos) << text;
  EXPECT_NE(text.find("corrupt_symmetric_omp M=5 threads=1 double FAILED its verification: "), text.npos) << text;
  const nlohmann::json document = tune_json(r, result, all, "p.json");
  EXPECT_EQ(document["profile"], "p.json");
  const std::string command = document["winner"]["command"];
  EXPECT_TRUE(
      command.starts_with("pairsum run --case dam_break --dx 0.06 --state perturbed --dim 3 --interaction "
                          "ferrari09 --smoothing wendland_c2 --backend " +
                          winner + " --grid hashed_grid --M 5 "))
      << command;
  for (const nlohmann::json& c : document["candidates"]) {
    const std::string backend = c["backend"];
    const bool wins = backend == winner, wrong = backend == "corrupt_symmetric_omp";
    EXPECT_EQ(c["verdict"].is_null(), wins || wrong) << c;
    EXPECT_EQ(c["look_s"].is_null(), wrong) << c;
    EXPECT_EQ(c["error"].is_null(), !wrong) << c;
    if (c["verdict"] == "slower") {
      EXPECT_GT(c["low"], 1.0) << c;
    }
  }
}

TEST(tune, colours_are_in_the_verdicts_alone_and_only_if_asked_for) {
  const registry all = with_self_test(registry::instance());
  const tune_request r = small({"naive_omp", "slowed_20_naive_omp", "corrupt_symmetric_omp"});
  const tune_result result = tune(r, all);
  const std::string plain = tune_text(r, result, all), coloured = tune_text(r, result, all, true);
  EXPECT_EQ(plain.find('\x1b'), plain.npos);
  EXPECT_NE(coloured.find("\x1b[31mFAILED\x1b[0m"), coloured.npos) << coloured;
  EXPECT_NE(coloured.find("take \x1b[1m"), coloured.npos) << coloured;
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9]+m"), ""), plain);
}

TEST(tune, M_that_do_not_go_round_a_periodic_box_are_left_out_unless_they_were_asked_for) {
  const registry& all = registry::instance();
  tune_request r = small({"naive", "symmetric"});
  r.levels.case_name = "periodic_lattice";
  r.levels.dx = {0.1};
  r.levels.M = {2, 5};
  r.all_M = false;
  const tune_result result = tune(r, all);
  ASSERT_TRUE(result.winner.has_value());
  EXPECT_EQ(result.points.size(), 2u);
  for (const point& p : result.points) EXPECT_EQ(p.M, 2);
  r.levels.M = {5};
  const auto refusal = [&] {
    try {
      tune(r, all);
      return std::string();
    } catch (const error& e) {
      return std::string(e.what());
    }
  };
  EXPECT_NE(refusal().find("none of the M"), std::string::npos) << refusal();
  r.all_M = true;
  EXPECT_NE(refusal().find("M = 5 does not fit"), std::string::npos) << refusal();
}

/// The winner is one that measuring everything equally often cannot tell from the best.
TEST(tune, the_winner_is_among_those_that_an_exhaustive_measurement_cannot_tell_from_the_best) {
  const registry& all = registry::instance();
  tune_request r = small({"naive", "symmetric", "sphysics_sweep", "pair_list"});
  const tune_result found = tune(r, all);
  r.rules.far_too_slow = 1e9;
  r.rules.drop_level = 1 - 1e-12;
  r.rules.most_rounds = 12;
  r.budget_s = 40;
  const tune_result exhaustive = tune(r, all);
  ASSERT_TRUE(found.winner && exhaustive.winner);
  const contestant& best = exhaustive.candidates[*exhaustive.winner];
  const contestant& chosen = of(exhaustive, found.points[*found.winner].backend);
  const ratio_estimate ratio = ratio_to(chosen, best, 0.999);
  EXPECT_TRUE(&chosen == &best || !ratio.bounds || ratio.bounds->low <= 1)
      << found.points[*found.winner].backend << " " << ratio.value;
}

TEST(tune, its_profile_reads_back_as_the_winner) {
  const registry& all = registry::instance();
  tune_request r = small({"symmetric"});
  r.levels.grids = {"compact_grid"};
  const tune_result result = tune(r, all);
  const nlohmann::json j = profile_json(r, result, all);
  EXPECT_EQ(j["schema"], profile_schema);
  EXPECT_EQ(j["words"], "backend=symmetric grid=compact_grid precision=double threads=1");
  EXPECT_EQ(j["rounds"], 6);
  EXPECT_GT(j["time_s"], 0);
}

TEST(tune, what_makes_no_sense_is_refused_before_anything_is_measured) {
  const auto refusal = [](const auto& change) -> std::string {
    tune_request r = small({"naive"});
    change(r);
    try {
      tune(r, registry::instance());
    } catch (const error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal([](auto& r) { r.budget_s = 0; }).find("budget must be a positive"), std::string::npos);
  EXPECT_NE(refusal([](auto& r) { r.phase = "nope"; }).find("valid: total, sum"), std::string::npos);
  EXPECT_NE(refusal([](auto& r) { r.levels.backends = {"nope"}; }).find("valid: naive"), std::string::npos);
  EXPECT_NE(refusal([](auto& r) { r.levels.dx = {0.1, 0.2}; }).find("tune takes one dx, not 2"), std::string::npos);
  EXPECT_NE(refusal([](auto& r) { r.budget_s = 1e-6; }).find("none of the 1 candidates was measured"),
            std::string::npos);
}

}  // namespace
}  // namespace pairsum::harness
