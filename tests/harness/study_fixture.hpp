#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <pairsum/core/error.hpp>
#include "harness/rows/reader.hpp"
#include "harness/run/study.hpp"
#include "harness/run/worker.hpp"

namespace pairsum::harness {

/// Studies in this process, in a folder of their own.
class study_test : public ::testing::Test {
 protected:
  study_test()
      : folder_(std::filesystem::path(testing::TempDir()) /
                (std::string("pairsum_") + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
                 std::to_string(::getpid()))),
        path_(folder_ / "rows.jsonl") {
    std::filesystem::remove_all(folder_);
  }
  ~study_test() override { std::filesystem::remove_all(folder_); }

  static run_request small() {
    run_request r;
    r.dx = {0.08};
    r.states = {"perturbed"};
    r.backends = {"naive", "symmetric_omp", "symmetric_tbb"};
    r.M = {3, 6};
    r.threads = {1, 2};
    r.steps = 3;
    r.repetitions = 2;
    return r;
  }

  static study_plan plan_of(const run_request& r, int rounds = 1) {
    study_plan plan;
    plan.study = r.study;
    part_plan part;
    part.request = r;
    part.least_rounds = part.most_rounds = rounds;
    plan.parts.push_back(part);
    return plan;
  }

  static int run(const study_plan& plan, const std::filesystem::path& path,
                 const registry& all = registry::instance()) {
    return conduct(plan, {path, "cores_first", {in_this_process(all)}}, all);
  }
  static int run(const run_request& r, const std::filesystem::path& path, const registry& all = registry::instance()) {
    return run(plan_of(r), path, all);
  }

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

inline study_plan study_of(std::vector<part_plan> parts) {
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

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// The message of the pairsum::error that f throws, or "".
template <class F>
std::string refusal_of(F&& f) {
  try {
    f();
  } catch (const error& e) {
    return e.what();
  }
  return "";
}

}  // namespace pairsum::harness
