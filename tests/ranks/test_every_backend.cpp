#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ranked_scene.hpp"

// Every backend on any number of ranks: within the reference's bound, the pairs of one rank, momentum kept.
namespace pairsum {
namespace {

using namespace test_kit;

struct world {
  scene s;
  std::map<std::string, expectation> expected;  // by interaction
};

const std::map<std::string, world>& worlds() {
  static const std::map<std::string, world> all = [] {
    std::map<std::string, world> made;
    made["dam_break"].s = make_scene("dam_break", 0.06, "perturbed");
    made["periodic_lattice"].s = make_scene_in(3, "periodic_lattice", 1.0 / 10, "perturbed");
    made["random_clustered"].s = make_scene_in(3, "random_clustered", 0.1, "perturbed");
    if (std::ranges::count(registry::instance().dims(), 2) > 0) {  // not every build has it
      made["dam_break_2D"].s = make_scene_in(2, "dam_break", 0.02, "perturbed");
      made["periodic_lattice_2D"].s = make_scene_in(2, "periodic_lattice", 1.0 / 24, "perturbed");
    }
    for (auto& [name, w] : made)
      for (formula_choice f : two_formulas) {
        f.dim = w.s.world.dim;
        w.expected[f.interaction] =
            registry::instance().make_reference(with(w.s.world, f))->brute_force(w.s.particles, some_threads());
      }
    return made;
  }();
  return all;
}

class every_backend : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(of, every_backend, testing::ValuesIn(backend_names()), [](const auto& i) { return i.param; });

TEST_P(every_backend, sums_on_ranks_what_one_sums) {
  const backend_traits& traits = registry::instance().find_backend(GetParam()).traits;
  for (const auto& [name, w] : worlds())
    for (formula_choice f : two_formulas) {
      f.dim = w.s.world.dim;
      const expectation& e = w.expected.at(f.interaction);
      const bool talk = f.interaction == "ferrari09";
      for (const grid_choice& grid :
           talk&& name == "dam_break" ? every_grid({4}) : std::vector{grid_choice{"compact_grid", 0}})
        for (const std::string isa : {"scalar", "best"}) {
          if (isa == "best" && (!talk || GetParam() == "atomic_add")) continue;
          for (const cut_pairs pairs : {cut_pairs::twice, cut_pairs::once}) {
            if (pairs == cut_pairs::once && !traits.symmetric) continue;
            SCOPED_TRACE(testing::Message() << name << " " << f.interaction << " " << grid << " " << isa
                                            << (pairs == cut_pairs::once ? " once" : " twice"));
            setup world = with(w.s.world, f, GetParam(), grid);
            world.isa = isa;
            auto sum = ranked(world, {.pairs = pairs});
            const workers team(traits.threads, 2);
            sum->load(w.s.particles, {});
            sum->evaluate(team.get());
            const rate_table rates = sum->rates();
            EXPECT_EQ(disagreement(rates, e), "");
            EXPECT_EQ(sum->count_work().pairs_fluid_fluid, e.pairs_fluid_fluid);
            if (!talk || !name.starts_with("periodic")) continue;
            for (std::size_t c = 1; c < rates.columns.size(); ++c) {  // momentum; the particles have one mass
              double sum_of = 0, size = 0;
              for (const double a : rates.columns[c]) sum_of += a, size += std::abs(a);
              EXPECT_LT(std::abs(sum_of), 1e-12 * size) << rates.names[c];
            }
          }
        }
    }
}

TEST(modes, a_gather_cannot_sum_cut_pairs_once) {
  setup s = with(worlds().at("dam_break").s.world, "naive_omp", 4);
  EXPECT_TRUE(says(error_of([&] { ranked(s, {.pairs = cut_pairs::once}); }), {"naive_omp", "one side", "use twice"}));
}

}  // namespace
}  // namespace pairsum
