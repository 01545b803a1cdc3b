#include <map>
#include <thread>

#include "harness/measure/memory.hpp"
#include "harness/self_test/forwarding_summation.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

constexpr std::size_t MiB = 1 << 20;

/// What `make` adds to the heap as long as its result lives; empty where the allocator does not tell.
template <class F>
std::optional<std::uint64_t> held_by(F&& make) {
  const auto before = heap_bytes();
  [[maybe_unused]] const auto kept = make();
  const auto now = heap_bytes();
  if (!before || !now) return std::nullopt;
  return *now - *before;
}

TEST(memory, of_the_heap_grows_by_what_is_held_and_by_nothing_else) {
  if (!heap_bytes()) GTEST_SKIP() << "this allocator does not tell";
  const auto held = held_by([] { return std::vector<char>(8 * MiB); });
  EXPECT_GE(*held, 8 * MiB);
  EXPECT_LT(*held, 9 * MiB);
  const auto freed = held_by([] { return std::vector<char>(8 * MiB).size(); });
  EXPECT_LT(*freed, MiB) << "what was freed is not held";
}

TEST(memory, of_other_threads_counts) {
  if (!heap_bytes()) GTEST_SKIP() << "this allocator does not tell";
  const auto held = held_by([] {
    std::vector<std::vector<char>> pieces(1000);
    std::thread([&] {
      for (auto& piece : pieces) piece.resize(10000);
    }).join();
    return pieces;
  });
  EXPECT_GE(*held, 10 * 1000 * 1000);
  EXPECT_LT(*held, 11 * 1000 * 1000);
}

/// Right, but it holds memory that it has no use for: from prepare() on, or in sum() alone.
class hoards final : public forwarding_summation {
 public:
  hoards(std::unique_ptr<summation> inner, std::string_view name, bool for_ever)
      : forwarding_summation(std::move(inner), name, "holds 16 MiB"), for_ever_(for_ever) {}
  void prepare(const team& t) override {
    forwarding_summation::prepare(t);
    hoard_.resize(16 * MiB);
    if (!for_ever_) std::vector<char>().swap(hoard_);
  }

 private:
  bool for_ever_;
  std::vector<char> hoard_;
};

registry with_hoards() {
  registry r = registry::instance();
  backend_traits t = r.find_backend("naive").traits;
  t.name = "hoards";
  r.add_wrapper(t, "naive", [](std::unique_ptr<summation> s, const setup&) -> std::unique_ptr<summation> {
    return std::make_unique<hoards>(std::move(s), "hoards", true);
  });
  t.name = "frees";
  r.add_wrapper(t, "naive", [](std::unique_ptr<summation> s, const setup&) -> std::unique_ptr<summation> {
    return std::make_unique<hoards>(std::move(s), "frees", false);
  });
  return r;
}

using workspace_memory = study_test;

TEST_F(workspace_memory, is_that_of_the_backend_whatever_was_measured_before_it) {
  if (!heap_bytes()) GTEST_SKIP() << "this allocator does not tell";
  run_request r = small();
  r.backends = {"naive", "hoards", "frees"};
  r.M = {6};
  r.repetitions = 3;
  ASSERT_EQ(run(r, path_, with_hoards()), 0);
  std::map<std::string, std::uint64_t> least, most;
  for (const sample& s : read_rows(path_).samples) {
    ASSERT_TRUE(s.workspace_bytes);
    auto& low = least.try_emplace(s.point.backend, *s.workspace_bytes).first->second;
    low = std::min(low, *s.workspace_bytes);
    most[s.point.backend] = std::max(most[s.point.backend], *s.workspace_bytes);
  }
  EXPECT_LT(most["naive"], MiB);
  EXPECT_LT(most["frees"], MiB);
  EXPECT_GE(least["hoards"], 16 * MiB);
  EXPECT_LT(most["hoards"], 17 * MiB);
}

}  // namespace
}  // namespace pairsum::harness
