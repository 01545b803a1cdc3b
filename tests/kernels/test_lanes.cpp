#include <gtest/gtest.h>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/random.hpp>
#include "scene.hpp"

// What only vector units have: places that are coarse, ties, rows. And blocks, which are made for them.
namespace pairsum {
namespace {

using namespace test_kit;

std::vector<std::string> precisions_of_positions_in_double() {
  std::vector<std::string> all = registry::instance().precisions();
  std::erase(all, "float");
  return all;
}

/// Backends that call each of a formula's functions on vector units; half_cells has places in an order of its own.
class lanes_test : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (isa_names().empty()) GTEST_SKIP() << "no set of this build runs on this machine";
  }
  static setup on_lanes(const setup& s, const grid_choice& grid) {
    setup world = with(s, GetParam(), grid);
    world.isa = best_isa;
    return world;
  }
};
INSTANTIATE_TEST_SUITE_P(backend, lanes_test,
                         testing::Values("naive_omp", "symmetric_omp", "touched_blocks", "pair_list_omp", "half_cells",
                                         "tiles_omp", "naive_tiles_omp"),
                         [](const auto& i) { return i.param; });

/// Vectors are counted for what they hold: every list of hits is filled up to whole ones.
TEST(work_counts, of_lanes_in_use) {
  work_counts counts;
  for (const std::uint64_t n : {0, 1, 8, 9, 17}) counts.evaluated(n, 1);
  counts.pairs_fluid_boundary = 5;
  EXPECT_EQ(counts.vectors,
            (std::array<std::uint64_t, 4>{0 + 1 + 4 + 5 + 9, 0 + 1 + 2 + 3 + 5, 0 + 1 + 1 + 2 + 3, 0 + 1 + 1 + 1 + 2}));
  EXPECT_EQ(counts.pairs_evaluated, 40u);
  EXPECT_EQ(counts.vectors_of(8), 7u);
  EXPECT_EQ(counts.vectors_of(1), 35u);
}

/// Places are counted modulo 2^32 from the first particle: 4096 reaches away they begin again.
TEST_P(lanes_test, particles_whose_places_coincide_do_not_meet) {
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
      setup world = on_lanes(s.world, grid);
      world.precision = precision;
      const auto expected = registry::instance().make_reference(world)->brute_force(twice, some_threads());
      EXPECT_EQ(disagreement(evaluated(world, twice)->rates(), expected), "") << precision;
    }
}

/// The wider the world, the coarser are numbers far from its first particle: pairs just inside the reach are found.
TEST_P(lanes_test, pairs_are_found_in_wide_worlds) {
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
    setup world = on_lanes(s.world, grid_choice("compact_grid", 0));
    for (const std::string& precision : precisions_of_positions_in_double()) {
      world.precision = precision;
      const auto expected = registry::instance().make_reference(world)->brute_force(pairs, some_threads());
      EXPECT_GT(expected.pairs_fluid_fluid, 100u);
      EXPECT_EQ(disagreement(evaluated(world, pairs)->rates(), expected), "") << width << " " << precision;
    }
  }
}

/// On a lattice of H/2 many pairs are as far apart as H but for rounding: every set takes and leaves the same ones.
TEST_P(lanes_test, pairs_at_the_reach_are_decided_alike) {
  scene s = make_scene("lattice", 0.1, "rest");
  const counter_random random(5);
  for (std::uint32_t i = 0; i < s.particles.size(); ++i) {
    for (std::uint32_t d = 0; d < 3; ++d) s.particles.v[d][i] = random.uniform(4 * i + d, -1, 1);
    s.particles.rho[i] *= 1 + 0.01 * random.uniform(4 * i + 3, -1, 1);
  }
  for (const formula_choice& f : formulas()) {
    if (f.dim != 3) continue;
    setup world = with(s.world, f, GetParam(), 4);
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    for (const std::string& isa : isas_for(f, GetParam())) {
      world.isa = isa;
      EXPECT_EQ(disagreement(evaluated(world, s.particles)->rates(), expected), "") << f << " " << isa;
    }
  }
}

/// Lengths from less than an atom to more than a galaxy: what is copied is scaled.
TEST_P(lanes_test, any_unit_of_length) {
  for (const double unit : {1e-25, 1e18, 1e22}) {
    scene s = make_scene("dam_break", 0.08, "perturbed");
    const auto scale = [unit](std::vector<double>& v) {
      for (double& a : v) a *= unit;
    };
    for (auto& c : s.particles.x) scale(c);
    scale(s.world.omega_low);
    scale(s.world.omega_high);
    s.world.constants.H *= unit;
    const setup world = on_lanes(s.world, 4);
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    EXPECT_GT(expected.pairs_fluid_fluid, 1000u);
    EXPECT_EQ(disagreement(evaluated(world, s.particles, 2)->rates(), expected), "") << unit;
  }
}

/// prepare() leaves rates at 0, so zero() has something to do only if they were summed since.
TEST_P(lanes_test, zero_begins_anew) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const setup world = on_lanes(s.world, 4);
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

class isa_test : public testing::TestWithParam<std::string> {
 protected:
  const scene s = make_scene("dam_break", 0.08, "rest");
  setup world = with(s.world, GetParam(), grid_choice("compact_grid", 0));
  const bool atomic = GetParam() == "atomic_add";
  std::string refusal() const {
    return error_of([&] { registry::instance().make_summation(world); });
  }
};
INSTANTIATE_TEST_SUITE_P(backend, isa_test, testing::ValuesIn(backend_names()), [](const auto& i) { return i.param; });

TEST_P(isa_test, is_what_was_asked_for) {
  const backend_traits& t = registry::instance().find_backend(GetParam()).traits;
  const auto names = isa_names();
  const std::string best(names.empty() ? scalar_isa : names.front());
  const auto told = [&](std::string_view asked) {
    world.isa = asked;
    const auto sum = registry::instance().make_summation(world);
    EXPECT_EQ(sum->lanes() > 1, sum->isa() != scalar_isa);
    return std::string(sum->isa());
  };
  EXPECT_EQ(told(default_isa), t.vector ? best : scalar_isa);
  EXPECT_EQ(told(scalar_isa), scalar_isa);
  for (const std::string_view isa : names) {
    if (atomic) {
      world.isa = isa;
      EXPECT_TRUE(
          says(refusal(), {"backend atomic_add does not run on vector units, whose lanes cannot add atomically"}));
    } else {
      EXPECT_EQ(told(isa), isa);
    }
  }
  if (!atomic) {
    EXPECT_EQ(told(best_isa), best);
  }
}

TEST_P(isa_test, wrong_words_are_refused) {
  world.isa = "avx9";
  EXPECT_TRUE(says(refusal(), {"unknown isa \"avx9\"", "valid: ", "scalar"})) << refusal();
#ifdef __x86_64__
  world.isa = "neon";
  EXPECT_TRUE(says(refusal(), {"isa neon is not in this build", "valid: "})) << refusal();
#endif
  world.isa = default_isa;
  if (!registry::instance().find_backend(GetParam()).traits.blocks) return;
  for (const char* wrong : {"ball:3", "slab:4:morton", "pencil:2:bundles", "brick:2:rows"}) {
    world.block = wrong;
    EXPECT_TRUE(says(refusal(), {"block must be auto", wrong})) << refusal();
  }
}

TEST_P(isa_test, blocks_are_told) {
  world.block = "pencil:4";
  EXPECT_EQ(evaluated(world, s.particles)->block(),
            registry::instance().find_backend(GetParam()).traits.blocks ? "pencil:4" : "none");
}

TEST_P(isa_test, every_block_is_within_the_bound) {
  const backend_traits& t = registry::instance().find_backend(GetParam()).traits;
  if (!t.blocks) GTEST_SKIP() << "has no blocks";
  const scene alive = make_scene("dam_break", 0.05, "perturbed");
  const auto expected = registry::instance().make_reference(alive.world)->brute_force(alive.particles, some_threads());
  for (const char* isa : {"scalar", "best"})
    for (const char* block : {"auto", "slab:2", "slab:8", "pencil:2", "pencil:4", "brick:2", "brick:16"}) {
      setup shaped = with(alive.world, GetParam(), 5);
      shaped.isa = isa;
      shaped.block = block;
      const auto alone = evaluated(shaped, alive.particles, 1);
      EXPECT_EQ(disagreement(alone->rates(), expected), "") << block << " " << isa;
      EXPECT_EQ(evaluated(shaped, alive.particles, 3)->fingerprint(), alone->fingerprint()) << block << " " << isa;
    }
}

}  // namespace
}  // namespace pairsum
