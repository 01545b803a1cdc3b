#include <gtest/gtest.h>

#include <pairsum/core/isa.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/schedule/kept_lists.hpp>
#include <pairsum/sum/setup_of.hpp>
#include <pairsum/sum/summation_in.hpp>
#include "periodic_box.hpp"
#include "scene.hpp"

// The list that is kept against a fresh search, while a dam breaks.
namespace pairsum {
namespace {

using namespace test_kit;

/// Backend verlet_list, and how often it made its list.
template <int D, class R>
class kept {
 public:
  explicit kept(const setup& s) : sum_(registry::instance().make_summation(s)) {}
  state<D, R>* operator->() { return &dynamic_cast<state<D, R>&>(*sum_); }
  summation& sum() { return *sum_; }
  std::size_t lists_made() const {
    return dynamic_cast<const kept_lists<D, R>&>(dynamic_cast<const summation_in<D, R>&>(*sum_).inner()).lists_made();
  }

 private:
  std::unique_ptr<summation> sum_;
};
using counting_list = kept<3, double>;
constexpr double skin_in_H = kept_lists<3, double>::traits.skin;

/// Takes the positions of a table, by id, without saying so: as if an integrator had moved the particles.
void move_to(counting_list& list, const particle_table& p) {
  auto& set = list->particles();
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
  list->load(start.particles, {});
  const double sound = start.eos.sound_speed0();
  const double dt = 0.04 * start.H / sound;  // s
  std::size_t reused = 0;
  for (int step = 0; step < 200; ++step) {
    const auto now = dam->snapshot();
    move_to(list, now);
    const std::size_t before = list.lists_made();
    list->evaluate(t);
    reused += list.lists_made() == before;
    const auto fresh = evaluated(with(world, "naive", 5, "count"), now);
    ASSERT_EQ(list->rates().columns, fresh->rates().columns) << "step " << step;
    ASSERT_EQ(dam->lost(), 0u);
    find_integrator("euler").step(
        *dam, dt, start.gravity, [&] { dam->evaluate(t); }, t);
  }
  EXPECT_GE(list.lists_made(), 4u) << "made, and made again three times";
  EXPECT_GE(reused, 100u) << "a list that is never kept proves nothing";
}

/// On vector units it hands on more than is in reach, which the sum of its rows leaves out.
TEST(verlet_list, kept_sums_agree_on_every_instruction_set) {
  const initial_condition start = make_case("dam_break", {.dx = 0.04});
  for (const char* backend : {"verlet_list", "verlet_list_tbb"})
    for (const std::string_view isa : isa_names()) {
      setup world = with(setup_of(start), backend, 5);
      world.isa = isa;
      counting_list list(world);
      const workers two(registry::instance().find_backend(backend).traits.threads, 2);
      const double dt = 0.04 * start.H / start.eos.sound_speed0();  // s
      list->load(start.particles, {});
      for (int step = 0; step < 30; ++step)
        find_integrator("euler").step(
            list.sum(), dt, start.gravity, [&] { list->evaluate(two.get()); }, two.get());
      const std::size_t made = list.lists_made();
      list->evaluate(two.get());
      EXPECT_EQ(list.lists_made(), made) << "this one is kept";
      EXPECT_LT(made, 15u);
      const expectation e = registry::instance().make_reference(world)->cell_search(list->snapshot(), some_threads());
      EXPECT_EQ(disagreement(list->rates(), e), "") << backend << " " << isa;
    }
}

class kept_list : public testing::Test {
 protected:
  scene s = make_scene("dam_break", 0.06, "perturbed");
  counting_list list{with(s.world, "verlet_list", 4, "count")};
  const double skin = skin_in_H * s.world.constants.H;

  void SetUp() override {
    list->load(s.particles, {});
    list->evaluate(team());
  }
  std::size_t made_after(auto&& change) {
    change();
    list->evaluate(team());
    return list.lists_made();
  }
  /// Moves fluid particle 5 of the set by so much along x.
  void push(double by) { list->particles().x[0][5] += by; }
};

TEST_F(kept_list, serves_until_a_particle_has_moved_half_the_skin) {
  EXPECT_EQ(made_after([] {}), 1u);
  EXPECT_EQ(made_after([&] { push(0.3 * skin); }), 1u);
  EXPECT_EQ(made_after([&] { push(0.15 * skin); }), 1u);
  EXPECT_EQ(made_after([&] { push(0.1 * skin); }), 2u);
  EXPECT_EQ(made_after([&] { push(-0.45 * skin); }), 2u) << "counted from the new list on";
}

TEST_F(kept_list, ends_with_what_it_was_made_of) {
  EXPECT_EQ(made_after([&] { list->forget_index(); }), 2u) << "particles were sorted by somebody else";
  EXPECT_EQ(made_after([&] { list->load(s.particles, {}); }), 3u) << "other particles";
  EXPECT_EQ(made_after([&] { list->particles().x[0][5] = std::numeric_limits<double>::quiet_NaN(); }), 4u);
  EXPECT_EQ(list->lost(), 1u) << "a position that is no number is found while a list serves";
  EXPECT_EQ(made_after([&] { list->particles().x[0][5] = s.world.omega_high[0] + skin / 100; }), 5u);
  EXPECT_EQ(list->lost(), 2u) << "who leaves Omega is found while a list serves";
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
  list->load(two, {});
  list->evaluate(team());
  EXPECT_EQ(list->rates().columns[0][0], 0.0);
  const std::size_t made = list.lists_made();
  list->particles().x[0][0] += 0.48 * skin;
  list->particles().x[0][1] -= 0.48 * skin;
  list->evaluate(team());
  EXPECT_EQ(list.lists_made(), made);
  EXPECT_EQ(list->rates().columns[0][0], 1.0);
}

/// Random particles in a periodic box of 5.3 H, of which many pairs lie apart by more than H through a face.
class periodic_list : public testing::Test {
 protected:
  scene s = make_periodic(box());
  static cloud box() {
    cloud c;
    c.dim = 3;
    c.fluid = 1500;
    c.H = 0.125;
    c.length = 5.3;
    return c;
  }
  /// Pairs of fluid nearer than `reach`.
  std::uint64_t pairs_within(double reach) const {
    const particle_table& p = s.particles;
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double square = 0;
        for (std::size_t d = 0; d < 3; ++d) {
          const double edge = s.world.omega_high[d] - s.world.omega_low[d], r = p.x[d][i] - p.x[d][j];
          square += std::pow(r - edge * std::round(r / edge), 2);
        }
        n += square < reach * reach;
      }
    return n;
  }
};

TEST_F(periodic_list, its_tests_are_the_pairs_in_reach_of_the_skin) {
  const double H = s.world.constants.H, far = H * (1 + skin_in_H);
  const work_counts n =
      evaluated(with(s.world, "verlet_list", grid_choice("compact_grid", 0), "count"), s.particles)->count_work();
  EXPECT_EQ(n.pairs_tested, pairs_within(far));
  EXPECT_EQ(n.pairs_fluid_fluid, pairs_within(H));
  EXPECT_GT(n.pairs_tested, n.pairs_fluid_fluid);
}

/// Everything drifts through the faces, slowly enough for lists to serve some steps.
TEST_F(periodic_list, serves_while_particles_go_through_the_faces) {
  const setup world = with(s.world, "verlet_list", grid_choice("compact_grid", 0), "count");
  counting_list list(world);
  list->load(s.particles, {});
  const double step = 0.2 * skin_in_H * world.constants.H;  // two fit into half the skin
  const int steps = 40;
  for (int k = 0; k < steps; ++k) {
    auto& set = list->particles();
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double by = set.id[i] % 2 == 0 ? step : -step;
      set.x[0][i] += by;
      s.particles.x[0][set.id[i]] += by;
    }
    list->evaluate(team());
    particle_table now = s.particles;  // in the box
    for (double& x : now.x[0]) {
      const double edge = world.omega_high[0] - world.omega_low[0];
      x = world.omega_low[0] + std::fmod(std::fmod(x - world.omega_low[0], edge) + edge, edge);
    }
    const auto fresh = evaluated(with(world, "naive", grid_choice("compact_grid", 0), "count"), now);
    ASSERT_EQ(list->rates().columns, fresh->rates().columns) << "step " << k;
    ASSERT_EQ(list->lost(), 0u);
  }
  EXPECT_LT(list.lists_made(), static_cast<std::size_t>(steps) / 2 + 5);
  EXPECT_GT(list.lists_made(), 5u);
}

/// A box so wide that floats beside its faces are coarse against the skin: no list may be trusted.
TEST(verlet_list_in_float, is_made_anew_where_rounding_is_as_wide_as_the_skin) {
  scene s = placed(2, {40000, 40000, 0}, 1, 2, [](std::size_t i) {
    return std::array<double, 3>{i == 0 ? 0.5 : 39999.5, 7, 0};
  });
  setup world = with(s.world, "verlet_list", grid_choice("compact_grid", 0), "count");
  world.precision = "float";
  kept<2, float> list(world);
  list->load(s.particles, {});
  list->evaluate(team());
  list->evaluate(team());
  EXPECT_EQ(list.lists_made(), 1u) << "wide, but resolved";
  s.world.omega_high = {4e6, 4e6};
  s.particles.x[0][1] = 4e6 - 0.5;
  world.omega_high = s.world.omega_high;
  kept<2, float> wide(world);
  wide->load(s.particles, {});
  wide->evaluate(team());
  wide->evaluate(team());
  EXPECT_EQ(wide.lists_made(), 2u);
}

TEST(verlet_list, that_does_not_fit_into_a_periodic_box_says_that_it_needs_room_for_its_skin) {
  const scene s = placed(2, {3, 3, 0}, 1, 1, [](std::size_t) { return std::array<double, 3>{1, 1, 0}; });
  const auto refusal = [&](const char* backend) {
    return error_of(
        [&] { (void)registry::instance().make_summation(with(s.world, backend, grid_choice("compact_grid", 0))); });
  };
  EXPECT_EQ(refusal("pair_list_omp"), "");
  EXPECT_TRUE(says(refusal("verlet_list"), {"backend verlet_list takes the support radius and a skin of 0.1 H"}))
      << refusal("verlet_list");
}

}  // namespace
}  // namespace pairsum
