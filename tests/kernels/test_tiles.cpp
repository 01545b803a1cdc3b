#include <gtest/gtest.h>

#include "core/isa.hpp"
#include "core/random.hpp"
#include "scene.hpp"
#include "sum/probe.hpp"

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

std::vector<std::string> precisions_of_positions_in_double() {
  std::vector<std::string> all = registry::instance().precisions();
  std::erase(all, "float");
  return all;
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

/// Vectors are counted for what they hold: every list of hits is filled up to whole ones.
TEST(tiles, lanes_in_use_are_counted) {
  work_probe probe;
  for (const std::uint64_t n : {0, 1, 8, 9, 17}) probe.pairs_of_one(n);
  EXPECT_EQ(probe.counts.vectors,
            (std::array<std::uint64_t, 4>{0 + 1 + 4 + 5 + 9, 0 + 1 + 2 + 3 + 5, 0 + 1 + 1 + 2 + 3, 0 + 1 + 1 + 1 + 2}));
  EXPECT_EQ(probe.counts.vectors_of(8), 7u);
  probe.counts.pairs_evaluated = 35;
  EXPECT_EQ(probe.counts.vectors_of(1), 35u);
}

TEST_P(tiles_test, blocks_and_lanes_are_told) {
  scene s = make_scene("dam_break", 0.06, "rest");
  setup world = with(s.world, GetParam(), grid_choice("compact_grid", 0));
  world.block = "pencil:4:morton";
  const auto sum = evaluated(world, s.particles);
  EXPECT_EQ(sum->block(), "pencil:4:morton");
  EXPECT_EQ(sum->lanes() > 1, !isa_names().empty());
  world.backend = "naive";
  EXPECT_EQ(evaluated(world, s.particles)->block(), "none");
  EXPECT_EQ(evaluated(world, s.particles)->lanes(), 1u);
}

/// Places are counted modulo 2^32 from the first particle: 4096 reaches away they begin again.
TEST_P(tiles_test, particles_whose_places_coincide_do_not_meet) {
  scene s = make_scene("dam_break", 0.06, "perturbed");
  const double turn = 4096 * s.world.constants.H;
  particle_table twice;
  for (const particle_kind kind : {particle_kind::fluid, particle_kind::boundary})
    for (const double shift : {0.0, turn})
      for (std::size_t i = 0; i < s.particles.size(); ++i) {
        if (s.particles.kind[i] != kind) continue;
        const std::size_t k = twice.size();
        twice.resize(k + 1);
        for (std::size_t d = 0; d < 3; ++d) {
          twice.x[d][k] = s.particles.x[d][i] + (d == 0 ? shift : 0);
          twice.v[d][k] = s.particles.v[d][i];
        }
        twice.rho[k] = s.particles.rho[i];
        twice.m[k] = s.particles.m[i];
        twice.kind[k] = kind;
      }
  s.world.omega_high[0] += turn;
  for (const std::string& precision : precisions_of_positions_in_double())
    for (const grid_choice& grid : {grid_choice("compact_grid", 0), grid_choice("hashed_grid", 2)}) {
      setup world = with(s.world, GetParam(), grid);
      world.precision = precision;
      const auto expected = registry::instance().make_reference(world)->brute_force(twice, some_threads());
      EXPECT_EQ(disagreement(evaluated(world, twice)->rates(), expected), "") << precision;
    }
}

/// The wider the world, the coarser are numbers far from its first particle: pairs just inside the reach are found.
TEST_P(tiles_test, pairs_are_found_in_wide_worlds) {
  scene s = make_scene("dam_break", 0.06, "perturbed");
  const double H = s.world.constants.H;
  const counter_random random(7);
  for (const double width : {1e8, 1e11, 1e13}) {
    particle_table pairs;
    pairs.resize(401);
    for (std::uint32_t k = 0; k < 401; ++k) {
      vec<3, double> x(0.4 * H, 0.4 * H, 0.4 * H);
      for (std::uint32_t d = 0; d < 3 && k > 0; ++d) x[d] = width * H * random.uniform(8 * ((k + 1) / 2) + d, 0.1, 0.9);
      if (k > 0 && k % 2 == 0) {
        vec<3, double> r;
        for (std::uint32_t d = 0; d < 3; ++d) r[d] = random.uniform(8 * ((k + 1) / 2) + 3 + d, -1, 1);
        x += 0.99997 * H / r.norm() * r;
      }
      for (std::size_t d = 0; d < 3; ++d) {
        pairs.x[d][k] = x[static_cast<int>(d)];
        pairs.v[d][k] = random.uniform(8 * k + 7, -1, 1);
      }
      pairs.rho[k] = s.particles.rho[0];
      pairs.m[k] = s.particles.m[0];
      pairs.kind[k] = particle_kind::fluid;
    }
    s.world.omega_low.assign(3, 0);
    s.world.omega_high.assign(3, width * H);
    setup world = with(s.world, GetParam(), grid_choice("compact_grid", 0));
    for (const std::string& precision : precisions_of_positions_in_double()) {
      world.precision = precision;
      const auto expected = registry::instance().make_reference(world)->brute_force(pairs, some_threads());
      EXPECT_GT(expected.pairs_fluid_fluid, 100u);
      EXPECT_EQ(disagreement(evaluated(world, pairs)->rates(), expected), "") << width << " " << precision;
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
  for (const char* block : {"auto", "slab:2", "slab:8", "pencil:2", "pencil:4", "brick:2", "brick:16", "slab:4:bundles",
                            "pencil:2:bundles", "brick:4:morton"}) {
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

/// prepare() leaves rates at 0, so zero() has something to do only if they were summed since.
TEST_P(tiles_test, zero_begins_anew) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const setup world = with(s.world, GetParam(), 4);
  const auto sum = registry::instance().make_summation(world);
  const workers some(sum->traits().threads, 2);
  sum->load(s.particles, {});
  sum->evaluate(some.get());
  const auto once = sum->fingerprint();
  sum->zero(some.get());
  sum->sum(some.get());
  sum->reduce(some.get());
  EXPECT_EQ(sum->fingerprint(), once);
  sum->sum(some.get());
  sum->reduce(some.get());
  EXPECT_NE(sum->fingerprint(), once) << "summed twice";
}

/// OpenMP and oneTBB go over the same blocks in the same order.
TEST(tiles, agree_to_the_bit) {
  const scene s = make_scene("dam_break", 0.045, "perturbed");
  const auto expected = evaluated(with(s.world, "tiles_omp", 5), s.particles)->fingerprint();
  EXPECT_EQ(evaluated(with(s.world, "tiles_tbb", 5), s.particles, 3)->fingerprint(), expected);
}

}  // namespace
}  // namespace pairsum
