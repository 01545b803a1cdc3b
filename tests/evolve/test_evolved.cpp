#include <cstdlib>
#include <filesystem>

#include <pairsum/core/error.hpp>
#include "harness/evolve/evolved.hpp"
#include "harness/evolve/moment_file.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

namespace fs = std::filesystem;

class evolved_states : public testing::Test {
 protected:
  void SetUp() override {
    if (!why_no_moment_files().empty()) GTEST_SKIP() << why_no_moment_files();
    folder_ = fs::temp_directory_path() / ("pairsum_evolved_" + std::to_string(getpid()));
    setenv("PAIRSUM_CACHE", folder_.c_str(), 1);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::size_t kept() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
};

TEST_F(evolved_states, are_made_once_and_read_again) {
  const case_parameters c{.dim = 2, .dx = 0.05, .state = "evolved:0.05"};
  const particles_of_request made = evolved("dam_break", c, 0.05);
  EXPECT_EQ(kept(), 1u);
  const fs::path file = fs::directory_iterator(folder_)->path();
  const auto time = fs::last_write_time(file);
  const particles_of_request again = evolved("dam_break", c, 0.05);
  EXPECT_EQ(fs::last_write_time(file), time);
  EXPECT_EQ(again.initial.particles.x, made.initial.particles.x);
  EXPECT_EQ(again.hash, made.hash);
  EXPECT_EQ(made.hash.size(), 16u);
  EXPECT_FALSE(made.facts.empty());
  const initial_condition rest = make_case("dam_break", {.dim = 2, .dx = 0.05});
  EXPECT_NE(made.initial.particles.x, rest.particles.x);
  EXPECT_EQ(made.initial.omega_high, rest.omega_high);
}

TEST_F(evolved_states, have_the_same_places_at_every_H) {
  const particles_of_request two = evolved("dam_break", {.dim = 2, .dx = 0.05}, 0.05);
  const particles_of_request more = evolved("dam_break", {.dim = 2, .dx = 0.05, .H = 0.173}, 0.05);
  EXPECT_EQ(two.initial.particles.x, more.initial.particles.x);
  EXPECT_DOUBLE_EQ(two.initial.H, 0.1);
  EXPECT_DOUBLE_EQ(more.initial.H, 0.173);
  EXPECT_EQ(kept(), 1u);
  evolved("dam_break", {.dim = 2, .dx = 0.06}, 0.05);
  EXPECT_EQ(kept(), 2u);
}

TEST_F(evolved_states, that_are_damaged_or_of_other_words_are_made_anew) {
  const case_parameters c{.dim = 2, .dx = 0.05};
  const auto made = evolved("dam_break", c, 0.05);
  const fs::path file = fs::directory_iterator(folder_)->path();
  fs::resize_file(file, 3000);
  EXPECT_EQ(evolved("dam_break", c, 0.05).hash, made.hash);
  const auto other = evolved("dam_break", c, 0.04);
  ASSERT_EQ(kept(), 2u);
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.path() != file) fs::copy_file(entry.path(), file, fs::copy_options::overwrite_existing);
  EXPECT_EQ(evolved("dam_break", c, 0.05).hash, made.hash);
  EXPECT_NE(other.hash, made.hash);
}

TEST_F(evolved_states, need_a_folder_that_can_be_made) {
  setenv("PAIRSUM_CACHE", "/dev/null/x", 1);
  EXPECT_THROW(evolved("dam_break", {.dim = 2, .dx = 0.05}, 0.05), error);
}

TEST(evolved_time, is_a_positive_number_behind_the_word) {
  EXPECT_EQ(evolved_time("evolved:0.5"), 0.5);
  EXPECT_EQ(evolved_time("rest"), std::nullopt);
  for (const char* wrong : {"evolved:", "evolved:0", "evolved:-1", "evolved:1s", "evolved:inf"})
    EXPECT_THROW(evolved_time(wrong), error) << wrong;
}

}  // namespace
}  // namespace pairsum::harness
