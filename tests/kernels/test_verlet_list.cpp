#include <gtest/gtest.h>

#include "backends/verlet_list.hpp"
#include "integrators/integrator.hpp"
#include "interactions/count.hpp"
#include "scene.hpp"
#include "sum/setup_of.hpp"
#include "sum/summation_of.hpp"

// The list that is kept against a fresh search, while a dam breaks.
namespace pairsum {
namespace {

using namespace test_kit;
using counted = count<3, double>;
using counting_list = summation_of<verlet_list, counted>;

/// Takes the positions of a table, by id, without saying so: as if an integrator had moved the particles.
void move_to(counting_list& list, const particle_table& p) {
  auto& set = list.particles();
  for (std::size_t i = 0; i < set.size(); ++i)
    for (int d = 0; d < 3; ++d) set.x[d][i] = p.x[static_cast<std::size_t>(d)][set.id[i]];
}

TEST(verlet_list, names_the_pairs_of_a_fresh_search_at_every_step) {
  const initial_condition start = make_case("dam_break", {.dx = 0.03});
  const setup world = with(setup_of(start), "symmetric", 5);
  const auto dam = registry::instance().make_summation(world);
  dam->load(start.particles, {});
  const team t;
  counting_list list(with(world, "verlet_list", 5, "count"));
  list.load(start.particles, {});
  const double sound = start.eos.sound_speed0();
  const double dt = 0.04 * start.H / sound;  // s
  std::size_t reused = 0;
  for (int step = 0; step < 200; ++step) {
    const auto now = dam->snapshot();
    move_to(list, now);
    const std::size_t before = list.inner().lists_made();
    list.evaluate(t);
    reused += list.inner().lists_made() == before;
    const auto fresh = evaluated(with(world, "naive", 5, "count"), now);
    ASSERT_EQ(list.rates().columns, fresh->rates().columns) << "step " << step;
    ASSERT_EQ(dam->lost(), 0u);
    find_integrator("euler").step(
        *dam, dt, start.gravity, [&] { dam->evaluate(t); }, t);
  }
  EXPECT_GE(list.inner().lists_made(), 4u) << "made, and made again three times";
  EXPECT_GE(reused, 100u) << "a list that is never kept proves nothing";
}

class kept_list : public testing::Test {
 protected:
  scene s = make_scene("dam_break", 0.06, "perturbed");
  counting_list list{with(s.world, "verlet_list", 4, "count")};
  const double skin = verlet_list::traits.skin * s.world.constants.H;

  void SetUp() override {
    list.load(s.particles, {});
    list.evaluate(team());
  }
  std::size_t made_after(auto&& change) {
    change();
    list.evaluate(team());
    return list.inner().lists_made();
  }
  /// Moves fluid particle 5 of the set by so much along x.
  void push(double by) { list.particles().x[0][5] += by; }
};

TEST_F(kept_list, serves_until_a_particle_has_moved_half_the_skin) {
  EXPECT_EQ(made_after([] {}), 1u);
  EXPECT_EQ(made_after([&] { push(0.3 * skin); }), 1u);
  EXPECT_EQ(made_after([&] { push(0.15 * skin); }), 1u);
  EXPECT_EQ(made_after([&] { push(0.1 * skin); }), 2u);
  EXPECT_EQ(made_after([&] { push(-0.45 * skin); }), 2u) << "counted from the new list on";
}

TEST_F(kept_list, ends_with_what_it_was_made_of) {
  EXPECT_EQ(made_after([&] { list.forget_index(); }), 2u) << "particles were sorted by somebody else";
  EXPECT_EQ(made_after([&] { list.load(s.particles, {}); }), 3u) << "other particles";
  EXPECT_EQ(made_after([&] { list.particles().x[0][5] = std::numeric_limits<double>::quiet_NaN(); }), 4u);
  EXPECT_EQ(list.lost(), 1u) << "a position that is no number is found while a list serves";
  EXPECT_EQ(made_after([&] { list.particles().x[0][5] = s.world.omega_high[0] + skin / 100; }), 5u);
  EXPECT_EQ(list.lost(), 2u) << "who leaves Omega is found while a list serves";
}

/// A pair that comes into reach while the list serves was in its skin.
TEST_F(kept_list, has_pairs_that_come_into_reach) {
  particle_table two(3);
  two.resize(2);
  two.kind.assign(2, particle_kind::fluid);
  two.rho.assign(2, 1000.0);
  two.m.assign(2, 1.0);
  const double H = s.world.constants.H;
  for (int d = 0; d < 3; ++d) two.x[static_cast<std::size_t>(d)].assign(2, 0.3);
  two.x[0][1] += H + 0.9 * skin;
  list.load(two, {});
  list.evaluate(team());
  EXPECT_EQ(list.rates().columns[0][0], 0.0);
  const std::size_t made = list.inner().lists_made();
  list.particles().x[0][0] += 0.48 * skin;
  list.particles().x[0][1] -= 0.48 * skin;
  list.evaluate(team());
  EXPECT_EQ(list.inner().lists_made(), made);
  EXPECT_EQ(list.rates().columns[0][0], 1.0);
}

}  // namespace
}  // namespace pairsum
