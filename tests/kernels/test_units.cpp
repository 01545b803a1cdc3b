#include <gtest/gtest.h>

#include <set>

#include <pairsum/schedule/block_conflicts.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "periodic_box.hpp"
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
  std::array<double, 3> reaches{};  ///< edges, in units of H, that the unit cube is pressed to; 0: it stays
  axes periodic{};                  ///< as well

  initial_condition make(int dim) const {
    initial_condition c =
        make_case(name, {.dim = dim, .dx = dx, .H = reaches[0] > 0 ? 1.0 / 8 : 0, .state = "perturbed"});
    for (int d = 0; d < dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      if (periodic[d]) c.periodic.on[k] = true;
      if (reaches[k] == 0) continue;
      c.omega_high[k] = reaches[k] * c.H;
      for (double& x : c.particles.x[k]) x *= c.omega_high[k];
    }
    return c;
  }
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
          {"periodic_lattice", 1.0 / 30, D == 3 ? std::vector<grid_choice>{} : grids_without_M()},
          // axes of 3 cells, and some that are open
          {"periodic_lattice", 1.0 / 12, grids_without_M(), {3, 3, 3}},
          {"periodic_lattice", 1.0 / 12, grids_without_M(), {3.5, 8, 6}},
          {"periodic_lattice", 1.0 / 12, grids_without_M(), {8, 6, 3}},
          {"random_uniform", D == 3 ? 0.08 : 0.02, every_grid({2}), {8, 9, 4.5}, along_x},
          {"random_uniform",
           D == 3 ? 0.08 : 0.02,
           grids_without_M(),
           {8, 3.5, 6},
           D == 1   ? along_x
           : D == 2 ? along_y
                    : along_yz}};
}

template <int D>
void units_of_a_pass_write_different_particles(const std::string& backend) {
  const backend_entry& b = registry::instance().find_backend(backend);
  std::size_t conflicts_of_all = 0;
  for (const world& w : worlds<D>())
    for (const grid_choice& grid : w.grids) {
      const initial_condition start = w.make(D);
      const scene s{start.particles, with(setup_of(start), backend, grid)};
      const indexed<D> i(s, s.world);
      const auto passes = units_of<D>(b, i.particles, i.index, s.world);
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

class units_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, units_test,
                         testing::Values("symmetric_omp", "colour18", "colour4", "half_cells", "pair_list_omp",
                                         "verlet_list", "tiles_omp", "sliced_2colour"),
                         [](const auto& i) { return i.param; });

TEST_P(units_test, of_a_pass_write_different_particles) {
  units_of_a_pass_write_different_particles<1>(GetParam());
  units_of_a_pass_write_different_particles<2>(GetParam());
  units_of_a_pass_write_different_particles<3>(GetParam());
}

/// Of two tasks that write to one particle one waits for the other; and of those that need not, many do not.
template <int D>
void tasks_that_write_to_one_particle_conflict() {
  std::size_t meetings = 0, apart = 0;
  for (const world& w : worlds<D>())
    for (const grid_choice& grid : w.grids)
      for (const char* block : {"slab:2", "brick:2"}) {
        const initial_condition start = w.make(D);
        scene s{start.particles, with(setup_of(start), "task_conflicts", grid)};
        s.world.block = block;
        const indexed<D> i(s, s.world);
        trace_units<D>(
            registry::instance().find_backend("task_conflicts"), i.particles, i.index, s.world,
            [&](const auto& p, const auto& tasks, const auto& trace) {
              cell_blocks<D> blocks;
              blocks.shape(block_shape::parse(tasks.block()), true);
              blocks.build(p.cells());
              const auto edges = conflicts_of(p.cells(), blocks);
              const std::set<block_pair> waits(edges.begin(), edges.end());
              std::vector<std::vector<std::size_t>> writers(p.fluid_count);
              const auto& units = trace.passes.at(0);
              ASSERT_EQ(units.size(), blocks.size(0)) << "every task runs once";
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
TEST_P(units_test, have_the_colours_of_their_pattern) {
  const backend_entry& b = registry::instance().find_backend(GetParam());
  if (!b.traits.sweeps_per_colour) GTEST_SKIP() << "blocks have colours of their own";
  const auto colours_in = [&](auto dim) {
    constexpr int D = decltype(dim)::value;
    const initial_condition start = make_case("random_uniform", {.dim = D, .dx = D == 3 ? 0.04 : 0.01});
    const scene s{start.particles, with(setup_of(start), GetParam(), grid_choice("dense_grid", 0))};
    const indexed<D> i(s, s.world);
    return static_cast<int>(units_of<D>(b, i.particles, i.index, s.world).size());
  };
  EXPECT_EQ(colours_in(std::integral_constant<int, 1>()), b.traits.colours[0]);
  EXPECT_EQ(colours_in(std::integral_constant<int, 2>()), b.traits.colours[1]);
  EXPECT_EQ(colours_in(std::integral_constant<int, 3>()), b.traits.colours[2]);
}

}  // namespace
}  // namespace pairsum
