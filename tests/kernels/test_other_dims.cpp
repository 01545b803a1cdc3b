#include <gtest/gtest.h>

#include "backends/naive.hpp"
#include "backends/pair_list.hpp"
#include "backends/symmetric_omp.hpp"
#include "interactions/ferrari09.hpp"
#include "scene.hpp"
#include "smoothing/wendland_c2.hpp"
#include "sum/reference_of.hpp"
#include "sum/summation_of.hpp"

// What the default build leaves out: 1D, 2D and float, for one backend of each way of finding
// pairs.
namespace pairsum {
namespace {

using namespace test_kit;

template <int D, class R>
struct world {
  static constexpr int dim = D;
  using formula = ferrari09<D, R, wendland_c2>;
  using counting = count<D, R>;
};
template <class World>
class other_dims_test : public testing::Test {
 protected:
  scene s;

  void make(const char* name, double dx) {
    const initial_condition c = make_case(name, {.dim = World::dim, .dx = dx, .state = "perturbed"});
    s.particles = c.particles;
    s.world.dim = World::dim;
    s.world.omega_low = c.omega_low;
    s.world.omega_high = c.omega_high;
    s.world.constants = {c.H, c.eos};
  }

  template <class B, class I>
  void agrees(const expectation& e) {
    for (const int M : {2, 5}) {
      s.world.M = M;
      summation_of<B, I> sum(s.world);
      sum.load(s.particles, {});
      sum.evaluate(team::omp(2));
      EXPECT_EQ(disagreement(sum.rates(), e), "") << B::traits.name << " M=" << M;
      EXPECT_EQ(sum.count_work().pairs_fluid_fluid, e.pairs_fluid_fluid);
    }
  }
  template <class I>
  void all_agree() {
    const reference_of<I> oracle(s.world);
    const expectation e = oracle.brute_force(s.particles, some_threads(), {});
    EXPECT_EQ(oracle.cell_search(s.particles, team()).pairs_fluid_fluid, e.pairs_fluid_fluid);
    EXPECT_GT(e.pairs_fluid_fluid, 50u);
    agrees<naive, I>(e);
    agrees<pair_list, I>(e);
    agrees<symmetric_omp, I>(e);
  }
};
using worlds = testing::Types<world<1, double>, world<2, double>, world<1, float>, world<2, float>, world<3, float>>;
TYPED_TEST_SUITE(other_dims_test, worlds);

TYPED_TEST(other_dims_test, lattice_agrees_with_brute_force) {
  this->make("lattice", TypeParam::dim == 1 ? 0.005 : TypeParam::dim == 2 ? 0.03 : 0.1);
  this->template all_agree<typename TypeParam::formula>();
  this->template all_agree<typename TypeParam::counting>();
}

template <class World>
class other_dims_of_dam_break : public other_dims_test<World> {};  // which does not exist in 1D
using dam_break_worlds = testing::Types<world<2, double>, world<2, float>, world<3, float>>;
TYPED_TEST_SUITE(other_dims_of_dam_break, dam_break_worlds);

TYPED_TEST(other_dims_of_dam_break, agrees_with_brute_force) {
  this->make("dam_break", TypeParam::dim == 2 ? 0.02 : 0.07);
  this->template all_agree<typename TypeParam::formula>();
  this->template all_agree<typename TypeParam::counting>();
}

}  // namespace
}  // namespace pairsum
