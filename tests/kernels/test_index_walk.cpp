#include <gtest/gtest.h>

#include <numeric>
#include <span>

#include <pairsum/grid/indexer.hpp>
#include <pairsum/sum/grids.hpp>
#include "any_world.hpp"

// Particles that walk at random: after every build they lie in the order of a stable sort of everything by the standard
// library, and cells are those of an indexer that sees them for the first time.
namespace pairsum {
namespace {

using namespace test_kit;

struct walk {
  world_kind kind;
  grid_choice grid;
};
std::ostream& operator<<(std::ostream& o, const walk& w) {
  o << w.kind << "_" << w.grid.name;
  return w.grid.M > 0 ? o << "_M" << w.grid.M : o;
}
std::vector<walk> walks() {
  std::vector<walk> all;
  for (const world_kind& kind : world_kinds())
    for (const grid_choice& grid : every_grid({2, 5})) all.push_back({kind, grid});
  return all;
}

class index_walk_test : public testing::TestWithParam<walk> {
 protected:
  const walk& w = GetParam();

  /// Calls f<D, R>() for the parameter's dimension and precision.
  template <class F>
  void typed(F&& f) const {
    const auto in = [&]<int D>() {
      if (w.kind.precision == "float") f.template operator()<D, float>();
      if (w.kind.precision == "double") f.template operator()<D, double>();
    };
    if (w.kind.dim == 1) in.template operator()<1>();
    if (w.kind.dim == 2) in.template operator()<2>();
    if (w.kind.dim == 3) in.template operator()<3>();
  }
};
INSTANTIATE_TEST_SUITE_P(every, index_walk_test, testing::ValuesIn(walks()),
                         [](const auto& i) { return testing::PrintToString(i.param); });

/// Ids in the order the particles must have: by kind, then by (folded) cell, last component first.
template <int D, class R>
std::vector<std::uint32_t> sorted_ids(const particle_set<D, R>& p, const box<D, R>& omega, R width, int M) {
  const auto place = [&](std::uint32_t i) {
    std::array<std::int64_t, D + 1> at{};
    const bool lost = p.kind[i] == particle_kind::lost || !omega.contains(p.position(i));
    at[0] = lost ? 2 : static_cast<std::int64_t>(p.kind[i]);
    const R inverse = 1 / width;
    for (int d = 0; d < D && !lost; ++d) {
      const auto c = static_cast<std::int64_t>((p.x[d][i] - omega.low[d]) * inverse);
      at[D - d] = M > 0 ? c & ((1 << M) - 1) : c;
    }
    return at;
  };
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, place);
  for (std::uint32_t& k : order) k = p.id[k];
  return order;
}

template <int D>
void expect_same_cells(const cells<D>& a, const cells<D>& b) {
  const auto same_range = [](const cell_range& r, const cell_range& s) {
    return r.fluid.begin == s.fluid.begin && r.fluid.end == s.fluid.end && r.boundary.size() == s.boundary.size() &&
           (r.boundary.size() == 0 || r.boundary.begin == s.boundary.begin);
  };
  ASSERT_EQ(a.fluid_cells, b.fluid_cells);
  EXPECT_EQ(a.total, b.total);
  EXPECT_TRUE(std::ranges::equal(a.range, b.range, same_range));
  const auto from_first = [&](const auto& all, std::size_t each) {  // what belongs to cell 0 is not set
    return std::span(all.data() + each, a.fluid_cells * each);
  };
  EXPECT_TRUE(std::ranges::equal(from_first(a.colour, 1), from_first(b.colour, 1)));
  EXPECT_TRUE(
      std::ranges::equal(from_first(a.neighbours, cells<D>::stencil), from_first(b.neighbours, cells<D>::stencil)));
}

/// One walk with one team. `share` of the fluid particles moves in a step, some far; some leave Omega at last.
template <int D, class R>
void walk_with(const walk& w, const team& t, double edges, double share, std::uint32_t fluid) {
  scene s = crowded_world(w.kind, edges, fluid);
  const setup world = with(s.world, "naive", w.grid, "count");
  const box<D, R> omega = make_box<D, R>(world);
  const R H = static_cast<R>(world.constants.H), width = safe_width(omega, H);
  indexer<D, R> index(omega, make_grid<D, R>(world));
  particle_set<D, R> p;
  fill(p, s.particles, shuffled(s.particles.size(), 3));
  for (std::uint32_t step = 0; step < 8; ++step) {
    const counter_random random(step, 5);
    for (std::size_t i = 0; i < index.fluid(); ++i) {
      const std::uint64_t at = 8 * p.id[i];
      if (random.uniform(at) >= share) continue;
      const bool far = random.uniform(at + 1) < 0.05;
      for (int d = 0; d < D; ++d) {
        const R way =
            static_cast<R>(random.uniform(at + 2 + static_cast<unsigned>(d), -1, 1)) * (far ? R(edges) : R(1));
        const R x = p.x[d][i] + way * H;
        p.x[d][i] = step < 5 ? std::clamp(x, omega.low[d], omega.high[d]) : x;
      }
    }
    if (step == 4) {  // boundary moves as well, and says so
      for (std::size_t i = index.fluid(); i < p.size(); ++i) p.x[0][i] = omega.high[0] - (p.x[0][i] - omega.low[0]) / 2;
      index.forget();
    }
    const auto expected = sorted_ids<D, R>(p, omega, width, w.grid.M);
    index.build(p, t);
    ASSERT_EQ((std::vector<std::uint32_t>(p.id.begin(), p.id.end())), expected) << "step " << step;
    indexer<D, R> fresh(omega, make_grid<D, R>(world));
    particle_set<D, R> copy = p;
    fresh.build(copy, team());
    ASSERT_EQ(copy.id, p.id);
    ASSERT_EQ(fresh.fluid(), index.fluid());
    ASSERT_EQ(fresh.boundary(), index.boundary());
    expect_same_cells(index.view(), fresh.view());
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST_P(index_walk_test, is_a_stable_sort_of_everything_for_every_team) {
  typed([&]<int D, class R>() {
    for (const auto& [kind, threads] :
         {std::pair{runtime::serial, 1}, {runtime::omp, 2}, {runtime::omp, 3}, {runtime::tbb, 3}}) {
      workers team(kind, threads);
      for (const double share : {0.0, 0.02, 0.1, 0.6})
        walk_with<D, R>(w, team.get(), D == 1 ? 60 : D == 2 ? 12 : 6, share, 500);
    }
  });
}

/// More threads than particles, and no particle.
TEST_P(index_walk_test, works_for_a_handful) {
  typed([&]<int D, class R>() {
    for (const std::uint32_t fluid : {0u, 1u, 3u, 6u}) walk_with<D, R>(w, team::omp(7), 5, 0.3, fluid);
  });
}

/// Worlds so large that compact_grid changes over to its list of cells, and back when the outlier is gone.
TEST_P(index_walk_test, follows_outliers_in_a_large_world) {
  if (w.grid.name == "dense_grid") GTEST_SKIP() << "refuses such worlds";
  typed([&]<int D, class R>() {
    for (const int threads : {1, 3}) walk_with<D, R>(w, team::omp(threads), 5e4, 0.02, 400);
  });
}

/// All particles drift: the box around them moves on in every step.
TEST_P(index_walk_test, box_moves_with_the_particles) {
  typed([&]<int D, class R>() {
    scene s = crowded_world(w.kind, 200, 700);
    const setup world = with(s.world, "naive", w.grid, "count");
    const box<D, R> omega = make_box<D, R>(world);
    const R H = static_cast<R>(world.constants.H);
    particle_set<D, R> p;
    fill(p, s.particles);
    for (int d = 0; d < D; ++d)
      for (std::size_t i = 0; i < p.size(); ++i) p.x[d][i] = omega.low[d] + (p.x[d][i] - omega.low[d]) / 40;
    for (std::size_t i = 0; i < p.size(); ++i) p.kind[i] = particle_kind::fluid;
    indexer<D, R> index(omega, make_grid<D, R>(world));
    std::size_t lost = 0;
    for (int step = 0; step < 30; ++step) {
      const auto expected = sorted_ids<D, R>(p, omega, safe_width(omega, H), w.grid.M);
      index.build(p, team::omp(2));
      lost += index.lost();
      ASSERT_EQ((std::vector<std::uint32_t>(p.id.begin(), p.id.end())), expected) << "step " << step;
      if (w.grid.name == "dense_grid") {
        EXPECT_LE(index.view().total, std::size_t{7 * 7 * 7}) << "follows";
      }
      for (std::size_t i = 0; i < p.size(); ++i) p.x[0][i] += H * R(7);
    }
    EXPECT_GT(lost, 0u);
    EXPECT_EQ(index.fluid() + lost, p.size());
  });
}

}  // namespace
}  // namespace pairsum
