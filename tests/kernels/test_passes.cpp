#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>

#include <pairsum/core/granularity.hpp>
#include "scene.hpp"

// What parallel backends tell of their passes, and how their loops can be shared out.
namespace pairsum {
namespace {

using namespace test_kit;

/// Notes the marks and what is wrong with their order.
class notes : public pass_observer {
 public:
  void pass_begins(unsigned pass) override { note(pass, open_passes_ == pass, "begins out of order"); }
  void work_begins(unsigned pass, int thread) override {
    const std::lock_guard lock(mutex_);
    ++begun[pass];
    if (working_[{pass, thread}]++ != 0) complaints.push_back("a thread begins work it has not ended");
    if (thread < 0 || thread >= most_threads) complaints.push_back("no such thread");
  }
  void work_ends(unsigned pass, int thread) override {
    const std::lock_guard lock(mutex_);
    ++ended[pass];
    if (--working_[{pass, thread}] != 0) complaints.push_back("a thread ends work it has not begun");
  }
  void pass_ends(unsigned pass) override {
    note(pass, open_passes_ == pass, "ends out of order");
    const std::lock_guard lock(mutex_);
    if (begun[pass] != ended[pass]) complaints.push_back("a pass ends while threads work");
    ++open_passes_;
  }

  unsigned finished() const { return open_passes_; }

  int most_threads = 1;
  std::map<unsigned, int> begun, ended;
  std::vector<std::string> complaints;

 private:
  void note(unsigned pass, bool fine, const char* what) {
    const std::lock_guard lock(mutex_);
    if (!fine) complaints.push_back("pass " + std::to_string(pass) + " " + what);
  }

  std::mutex mutex_;
  std::map<std::pair<unsigned, int>, int> working_;
  unsigned open_passes_ = 0;
};

class passes_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, passes_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// How many passes a sum in 3D marks; blocks have the colours of their shape.
unsigned passes_of(const summation& sum) {
  const backend_traits& t = sum.traits();
  if (t.threads == runtime::serial) return 0;
  if (!t.blocks || !t.symmetric || t.conflicts != conflict_avoidance::colours)
    return static_cast<unsigned>(t.colours[2]);
  const std::string block = sum.block();
  return block.starts_with("slab") ? 2 : block.starts_with("pencil") ? 4 : 8;
}

TEST_P(passes_test, marks_are_complete_and_in_order) {
  const scene s = make_scene("dam_break", 0.045, "perturbed");
  for (const int threads : {1, 2, 3}) {
    const auto sum = registry::instance().make_summation(with(s.world, GetParam(), grid_choice("dense_grid", 0)));
    const backend_traits& traits = sum->traits();
    const workers w(traits.threads, threads);
    notes seen;
    seen.most_threads = threads;
    sum->load(s.particles, {});
    sum->observe(&seen);
    sum->evaluate(w.get());
    EXPECT_TRUE(seen.complaints.empty()) << seen.complaints.front();
    EXPECT_EQ(seen.finished(), passes_of(*sum));
    for (const auto& [pass, times] : seen.begun) {
      if (traits.threads != runtime::omp) continue;
      if (traits.conflicts == conflict_avoidance::locks)
        EXPECT_GE(times, threads) << "every thread, and again when it has waited, in pass " << pass;
      else
        EXPECT_EQ(times, threads) << "every thread, once, in pass " << pass;
    }
    sum->observe(nullptr);
    sum->evaluate(w.get());
    EXPECT_EQ(seen.finished(), passes_of(*sum)) << "marked for nobody";
  }
}

TEST(passes, are_those_of_the_pattern) {
  const auto of = [](const char* backend) { return registry::instance().find_backend(backend).traits.colours[2]; };
  EXPECT_EQ(of("naive_omp"), 1);
  EXPECT_EQ(of("symmetric_omp"), 8);
  EXPECT_EQ(of("sliced_2colour"), 2);
  EXPECT_EQ(of("colour4"), 4);
  EXPECT_EQ(of("colour18"), 18);
  EXPECT_EQ(of("half_cells"), 27);
  for (const char* backend :
       {"sliced_locks", "task_conflicts", "atomic_add", "thread_private", "touched_blocks", "per_pass_buffers"})
    EXPECT_EQ(of(backend), 1) << backend;
}

/// Nor the rates beyond their bound, for those whose order of additions is left to chance.
TEST_P(passes_test, granularity_does_not_change_a_bit) {
  const scene s = make_scene("dam_break", 0.045, "perturbed");
  const setup world = with(s.world, GetParam(), 4);
  const auto expected = evaluated(world, s.particles)->fingerprint();
  const auto sum = registry::instance().make_summation(world);
  const bool deterministic = sum->traits().deterministic;
  const expectation bounds =
      deterministic ? expectation{} : registry::instance().make_reference(world)->cell_search(s.particles, team());
  const runtime kind = sum->traits().threads;
  const std::vector<std::string> words =
      kind == runtime::omp   ? std::vector<std::string>{"dynamic:1", "dynamic:500", "static:0", "static:7", "guided:2"}
      : kind == runtime::tbb ? std::vector<std::string>{"auto:1", "simple:8", "static:1", "auto:100000"}
                             : std::vector<std::string>{"none"};
  const workers w(kind, 3);
  for (const std::string& word : words) {
    sum->load(s.particles, {});
    sum->evaluate(w.get().with(parse_granularity(word, kind)));
    if (deterministic)
      EXPECT_EQ(sum->fingerprint(), expected) << word;
    else
      EXPECT_EQ(disagreement(sum->rates(), bounds), "") << word;
  }
}

TEST(granularity, words_go_there_and_back) {
  for (const char* word : {"dynamic:32", "guided:1", "static:0", "static:64"})
    EXPECT_EQ(name_of(parse_granularity(word, runtime::omp)), word);
  for (const char* word : {"auto:32", "simple:1", "static:8"})
    EXPECT_EQ(name_of(parse_granularity(word, runtime::tbb)), word);
  EXPECT_EQ(name_of(parse_granularity("dynamic:32", runtime::serial)), "none");
}

TEST(granularity, every_parallel_backend_has_one_of_its_runtime) {
  for (const backend_entry& b : registry::instance().backends()) {
    const std::string word = name_of(b.traits.loop);
    EXPECT_EQ(word == "none", b.traits.threads == runtime::serial) << b.traits.name;
    EXPECT_EQ(name_of(parse_granularity(word, b.traits.threads)), word) << b.traits.name;
  }
}

TEST(granularity, wrong_words_are_refused_with_the_right_ones) {
  for (const char* word : {"", "dynamic", "dynamic:", "dynamic:0", "dynamic:x", "dynamic:4x", "dynamic:-1", "auto:4",
                           "static:99999999999", "none"})
    EXPECT_TRUE(says(error_of([&] { parse_granularity(word, runtime::omp); }), {"OpenMP", "dynamic:N", "guided:N"}))
        << word;
  for (const char* word : {"dynamic:4", "static:0", "auto:0", ":", "simple"})
    EXPECT_TRUE(says(error_of([&] { parse_granularity(word, runtime::tbb); }), {"oneTBB", "auto:N", "simple:N"}))
        << word;
}

/// On a grid large enough to fold nothing, a backend makes just the tests that are said to be needed.
TEST_P(passes_test, unfolded_tests_are_those_of_a_large_grid) {
  const scene s = make_scene("dam_break", 0.06, "perturbed");
  const auto& traits = registry::instance().find_backend(GetParam()).traits;
  if (traits.cells_per_reach != 1 || traits.skin > 0) GTEST_SKIP() << "the cells are others";
  for (const int M : {3, 7}) {
    const auto sum = evaluated(with(s.world, GetParam(), M), s.particles);
    const auto unfolded = sum->count_unfolded_tests();
    ASSERT_TRUE(unfolded);
    const std::uint64_t least = sum->traits().symmetric ? unfolded->symmetric : unfolded->gather;
    const std::uint64_t tested = sum->count_work().pairs_tested;
    EXPECT_TRUE(M == 7 ? tested == least : tested > least) << "M=" << M << ": " << tested << " tests, not " << least;
  }
}

}  // namespace
}  // namespace pairsum
