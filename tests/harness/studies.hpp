#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "harness/rows/reader.hpp"
#include "harness/run/study.hpp"

namespace pairsum::harness {

/// A folder of its own for each test, away afterwards.
class study_test : public ::testing::Test {
 protected:
  study_test()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("pairsum_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())),
        path_(folder_ / "rows.jsonl") {
    std::filesystem::remove_all(folder_);
  }
  ~study_test() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_, path_;
};

/// A part of few particles that is measured in milliseconds.
inline part_plan small_part(const std::string& name, int rounds) {
  part_plan p;
  p.request.study = "test";
  p.request.part = name;
  p.request.dx = {0.1};
  p.request.states = {"perturbed"};
  p.request.backends = {"naive"};
  p.request.M = {3};
  p.request.steps = 2;
  p.least_rounds = p.most_rounds = rounds;
  return p;
}

inline study_plan plan_of(std::vector<part_plan> parts) {
  study_plan plan;
  plan.study = "test";
  plan.title = "A test";
  plan.parts = std::move(parts);
  return plan;
}

/// Carries a plan out in this process, unless launchers are given.
inline int conduct_here(const study_plan& plan, const std::filesystem::path& out,
                        const registry& all = registry::instance(), std::vector<launcher> builds = {}) {
  if (builds.empty()) builds.push_back(in_this_process(all));
  return conduct(plan, {out, "none", std::move(builds)}, all);
}

/// One part, one round.
inline int measure_once(const run_request& r, const std::filesystem::path& out,
                        const registry& all = registry::instance()) {
  part_plan part;
  part.request = r;
  part.least_rounds = part.most_rounds = 1;
  study_plan plan = plan_of({part});
  plan.study = r.study;
  return conduct_here(plan, out, all);
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace pairsum::harness
