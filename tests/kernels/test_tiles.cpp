#include <gtest/gtest.h>

#include "core/isa.hpp"
#include "core/random.hpp"
#include "scene.hpp"

// What only vector backends have: instruction sets, blocks, copies of limited size.
namespace pairsum {
namespace {

using namespace test_kit;

std::vector<std::string> vector_backends() {
  std::vector<std::string> names;
  for (const std::string& b : backend_names())
    if (registry::instance().find_backend(b).traits.vector) names.push_back(b);
  return names;
}

class tiles_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, tiles_test, testing::ValuesIn(vector_backends()),
                         [](const auto& i) { return i.param; });

TEST_P(tiles_test, every_instruction_set_is_within_the_bound) {
  if (isa_names().empty()) GTEST_SKIP() << "no set of this build runs on this machine";
  for (const formula& f : formulas()) {
    scene s = make_scene(f.dim == 1 ? "lattice" : "dam_break", f.dim == 3 ? 0.06 : 0.02, "perturbed");
    if (s.world.dim != f.dim) {
      case_parameters c{.dim = f.dim, .dx = f.dim == 1 ? 0.005 : 0.03, .state = "perturbed"};
      const auto made = make_case(f.dim == 1 ? "lattice" : "dam_break", c);
      s = {made.particles, s.world};
      s.world.dim = f.dim;
      s.world.omega_low = made.omega_low;
      s.world.omega_high = made.omega_high;
      s.world.constants = {made.H, made.eos};
    }
    setup world = with(s.world, f, GetParam(), grid_choice("compact_grid", 0));
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    for (const std::string_view isa : isa_names()) {
      world.isa = isa;
      EXPECT_EQ(disagreement(evaluated(world, s.particles, 2)->rates(), expected), "") << f << " " << isa;
    }
  }
}

/// On a lattice of H/2 many pairs are as far apart as H but for rounding: every set takes and leaves the same ones.
TEST_P(tiles_test, pairs_at_the_reach_are_decided_alike) {
  scene s = make_scene("lattice", 0.1, "rest");
  const counter_random random(5);
  for (std::uint32_t i = 0; i < s.particles.size(); ++i) {
    for (std::uint32_t d = 0; d < 3; ++d) s.particles.v[d][i] = random.uniform(4 * i + d, -1, 1);
    s.particles.rho[i] *= 1 + 0.01 * random.uniform(4 * i + 3, -1, 1);
  }
  for (const formula& f : formulas()) {
    if (f.dim != 3) continue;
    setup world = with(s.world, f, GetParam(), 4);
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    for (const std::string_view isa : isa_names()) {
      world.isa = isa;
      EXPECT_EQ(disagreement(evaluated(world, s.particles)->rates(), expected), "") << f << " " << isa;
    }
  }
}

/// More candidates around a cell than are copied at once, more particles in it than a batch takes.
TEST_P(tiles_test, crowded_cells_are_summed_in_pieces) {
  scene s;
  const double H = s.world.constants.H = 0.1;
  s.world.omega_low = {0, 0, 0};
  s.world.omega_high = {1, 1, 1};
  const counter_random random(3);
  const std::uint32_t n = 2600;
  s.particles.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t d = 0; d < 3; ++d) {
      s.particles.x[d][i] = 0.4 + 1.4 * H * random.uniform(3 * i + d);
      s.particles.v[d][i] = random.uniform(3 * i + d + 100000, -1, 1);
    }
    s.particles.rho[i] = 1000 + i % 7;
    s.particles.m[i] = 1e-3 * (1 + i % 3);
    s.particles.kind[i] = i < 1300 ? particle_kind::fluid : particle_kind::boundary;
  }
  for (const char* interaction : {"ferrari09", "count"}) {
    const setup world = with(s.world, GetParam(), 4, interaction);
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    EXPECT_GT(expected.pairs_fluid_boundary, 100000u);
    EXPECT_EQ(disagreement(evaluated(world, s.particles, 3)->rates(), expected), "") << interaction;
  }
}

TEST_P(tiles_test, every_block_is_within_the_bound) {
  const scene s = make_scene("dam_break", 0.05, "perturbed");
  setup world = with(s.world, GetParam(), 5);
  const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
  for (const char* block : {"auto", "slab:2", "slab:8", "pencil:2", "pencil:4", "brick:2", "brick:16"}) {
    world.block = block;
    const auto alone = evaluated(world, s.particles, 1);
    EXPECT_EQ(disagreement(alone->rates(), expected), "") << block;
    EXPECT_EQ(evaluated(world, s.particles, 3)->fingerprint(), alone->fingerprint()) << block;
  }
}

TEST_P(tiles_test, wrong_words_are_refused) {
  if (isa_names().empty()) GTEST_SKIP() << "no set of this build runs on this machine";
  const scene s = make_scene("dam_break", 0.08, "rest");
  setup world = with(s.world, GetParam(), 5);
  const auto made = [&] { registry::instance().make_summation(world); };
  world.isa = "avx9";
  EXPECT_TRUE(says(error_of(made), {"unknown isa \"avx9\"; valid: best", std::string(isa_names().front())}));
  world.isa = "neon";
#ifdef __x86_64__
  EXPECT_TRUE(says(error_of(made), {"isa neon is not in this build", "valid: best"}));
#endif
  world.isa = "best";
  world.block = "ball:3";
  EXPECT_TRUE(says(error_of(made), {"block must be auto", "ball:3"}));
}

/// Lengths from less than an atom to more than a galaxy: what is copied is scaled.
TEST_P(tiles_test, any_unit_of_length) {
  for (const double unit : {1e-25, 1e18, 1e22}) {
    scene s = make_scene("dam_break", 0.08, "perturbed");
    const auto scale = [unit](std::vector<double>& v) {
      for (double& a : v) a *= unit;
    };
    for (auto& c : s.particles.x) scale(c);
    scale(s.world.omega_low);
    scale(s.world.omega_high);
    s.world.constants.H *= unit;
    const setup world = with(s.world, GetParam(), 4);
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    EXPECT_GT(expected.pairs_fluid_fluid, 1000u);
    EXPECT_EQ(disagreement(evaluated(world, s.particles, 2)->rates(), expected), "") << unit;
  }
}

TEST_P(tiles_test, a_larger_team_than_prepared_is_refused) {
  const scene s = make_scene("dam_break", 0.08, "rest");
  const setup world = with(s.world, GetParam(), 4);
  const auto sum = registry::instance().make_summation(world);
  const workers one(sum->traits().threads, 1), three(sum->traits().threads, 3);
  sum->load(s.particles, {});
  sum->index(three.get());
  sum->prepare(one.get());
  sum->zero(three.get());
  EXPECT_EQ(error_of([&] { sum->sum(three.get()); }), "prepared for 1 threads, but to be summed on 3");
  EXPECT_EQ(error_of([&] { sum->sum(one.get()); }), "");
}

/// OpenMP and oneTBB go over the same blocks in the same order.
TEST(tiles, agree_to_the_bit) {
  const scene s = make_scene("dam_break", 0.045, "perturbed");
  const auto expected = evaluated(with(s.world, "tiles_omp", 5), s.particles)->fingerprint();
  EXPECT_EQ(evaluated(with(s.world, "tiles_tbb", 5), s.particles, 3)->fingerprint(), expected);
}

}  // namespace
}  // namespace pairsum
