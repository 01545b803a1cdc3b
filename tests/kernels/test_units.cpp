#include <gtest/gtest.h>

#include <set>

#include "backends/colour18.hpp"
#include "backends/colour4.hpp"
#include "backends/half_cells.hpp"
#include "backends/pair_list_omp.hpp"
#include "backends/sliced_2colour.hpp"
#include "backends/symmetric_omp.hpp"
#include "backends/task_conflicts.hpp"
#include "scene.hpp"
#include "sum/grids.hpp"
#include "sum/setup_of.hpp"
#include "unit_trace.hpp"

// Is a colour free of conflicts on every grid, the seams of a torus that three colours do not go round among them?
namespace pairsum {
namespace {

using namespace test_kit;

template <int D>
struct indexed {
  particle_set<D, double> particles;
  indexer<D, double> index;
  explicit indexed(const scene& s, const setup& w) : index(make_box<D, double>(w), make_grid<D, double>(w)) {
    fill(particles, s.particles);
    index.build(particles, team());
  }
};

/// A case in D dimensions with the grids it is tried on.
struct world {
  const char* name;
  double dx;
  std::vector<grid_choice> grids;
};

template <int D>
std::vector<world> worlds() {
  const double fine = D == 3 ? 0.06 : 0.02;
  return {{"random_uniform", fine, every_grid({2, 3, 4})},
          {"random_clustered", fine, every_grid({2, 3})},
          // boxes of 4, 8, 10 and 14 cells, of which 3 divides none
          {"periodic_lattice", 1.0 / 8, every_grid({2})},
          {"periodic_lattice", 1.0 / 16, every_grid({2, 3})},
          {"periodic_lattice", 1.0 / 22, grids_without_M()},
          {"periodic_lattice", 1.0 / 30, D == 3 ? std::vector<grid_choice>{} : grids_without_M()}};
}

template <class B, int D>
void units_of_a_pass_write_different_particles() {
  std::size_t conflicts_of_all = 0;
  for (const world& w : worlds<D>())
    for (const grid_choice& grid : w.grids) {
      const initial_condition start = make_case(w.name, {.dim = D, .dx = w.dx, .state = "perturbed"});
      const scene s{start.particles, with(setup_of(start), B::traits.name, grid)};
      const indexed<D> i(s, s.world);
      const auto passes = units_of<B, D>(i.particles, i.index, s.world);
      written_by_unit together;
      for (const auto& [pass, units] : passes) {
        EXPECT_EQ(conflicts_in(units, i.index.fluid()), 0u)
            << D << "D " << w.name << " " << w.dx << " " << grid << " pass " << pass;
        together.insert(together.end(), units.begin(), units.end());
      }
      conflicts_of_all += conflicts_in(together, i.index.fluid());
    }
  EXPECT_GT(conflicts_of_all, 0u) << "passes at the same time would not do: what is said above can fail";
}

template <class B>
class units_test : public testing::Test {};
using coloured = testing::Types<symmetric_omp, colour18, colour4, half_cells, pair_list_omp, sliced_2colour>;
struct backend_name {
  template <class B>
  static std::string GetName(int) {
    return std::string(B::traits.name);
  }
};
TYPED_TEST_SUITE(units_test, coloured, backend_name);

TYPED_TEST(units_test, of_a_pass_write_different_particles) {
  units_of_a_pass_write_different_particles<TypeParam, 1>();
  units_of_a_pass_write_different_particles<TypeParam, 2>();
  units_of_a_pass_write_different_particles<TypeParam, 3>();
}

/// Of two tasks that write to one particle one waits for the other; and of those that need not, many do not.
template <int D>
void tasks_that_write_to_one_particle_conflict() {
  std::size_t meetings = 0, apart = 0;
  for (const world& w : worlds<D>())
    for (const grid_choice& grid : w.grids)
      for (const char* block : {"slab:2", "brick:2"}) {
        const initial_condition start = make_case(w.name, {.dim = D, .dx = w.dx, .state = "perturbed"});
        scene s{start.particles, with(setup_of(start), "task_conflicts", grid)};
        s.world.block = block;
        const indexed<D> i(s, s.world);
        trace_units<task_conflicts, D>(
            i.particles, i.index, s.world, [&](const auto& p, const auto& workspace, const auto& trace) {
              const auto edges = conflicts_of(p.cells(), workspace.blocks);
              const std::set<block_pair> waits(edges.begin(), edges.end());
              std::vector<std::vector<std::size_t>> writers(p.fluid_count);
              const auto& units = trace.passes.at(0);
              ASSERT_EQ(units.size(), workspace.blocks.size(0)) << "every task runs once";
              for (std::size_t u = 0; u < units.size(); ++u)
                for (const std::uint32_t particle : units[u]) writers[particle].push_back(trace.numbers[u]);
              for (const auto& those : writers)
                for (const std::size_t a : those)
                  for (const std::size_t b : those)
                    if (a < b) {
                      ++meetings;
                      EXPECT_TRUE(waits.contains({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}))
                          << D << "D " << w.name << " " << w.dx << " " << grid << " " << block << ": " << a << ", "
                          << b;
                    }
              apart += units.size() * (units.size() - 1) / 2 - waits.size();
            });
      }
  EXPECT_GT(meetings, 0u);
  EXPECT_GT(apart, 0u);
}
TEST(units_of_tasks, that_write_to_one_particle_wait_for_each_other) {
  tasks_that_write_to_one_particle_conflict<1>();
  tasks_that_write_to_one_particle_conflict<2>();
  tasks_that_write_to_one_particle_conflict<3>();
}

/// Without a seam there are the colours that give a backend its name.
TYPED_TEST(units_test, have_the_colours_of_their_pattern) {
  if (!TypeParam::traits.sweeps_per_colour) GTEST_SKIP() << "blocks have colours of their own";
  const auto colours_in = [](auto dim) {
    constexpr int D = decltype(dim)::value;
    const initial_condition start = make_case("random_uniform", {.dim = D, .dx = D == 3 ? 0.04 : 0.01});
    const scene s{start.particles, with(setup_of(start), TypeParam::traits.name, grid_choice("dense_grid", 0))};
    const indexed<D> i(s, s.world);
    return static_cast<int>(units_of<TypeParam, D>(i.particles, i.index, s.world).size());
  };
  EXPECT_EQ(colours_in(std::integral_constant<int, 1>()), TypeParam::traits.colours[0]);
  EXPECT_EQ(colours_in(std::integral_constant<int, 2>()), TypeParam::traits.colours[1]);
  EXPECT_EQ(colours_in(std::integral_constant<int, 3>()), TypeParam::traits.colours[2]);
}

}  // namespace
}  // namespace pairsum
