#include <gtest/gtest.h>

#include "broken_backends.hpp"
#include "interactions/count.hpp"
#include "interactions/ferrari09.hpp"
#include "scene.hpp"
#include "smoothing/wendland_c2.hpp"

// Verification must reject a backend that is wrong in a single pair, and accept the same backend
// without the fault.
namespace pairsum {
namespace {

using namespace test_kit;

template <fault F>
struct with_fault {
  static constexpr fault value = F;
};

template <class Fault>
class broken_backends_test : public testing::Test {
 protected:
  const scene s = make_scene("dam_break", 0.055, "perturbed");

  template <class I>
  std::string verdict(int M) {
    const setup world = with(s.world, "", M, I::name);
    summation_of<broken_symmetric<Fault::value>, I> sum(world);
    sum.load(s.particles, {});
    sum.evaluate(team());
    return disagreement(sum.rates(),
                        registry::instance().make_reference(world)->brute_force(s.particles, some_threads()));
  }
};
using faults = testing::Types<with_fault<fault::none>, with_fault<fault::drop_pair>, with_fault<fault::double_pair>,
                              with_fault<fault::flip_sign>>;
TYPED_TEST_SUITE(broken_backends_test, faults);

TYPED_TEST(broken_backends_test, one_wrong_pair_is_rejected) {
  for (const int M : {2, 4, 6}) {
    const std::string text = this->template verdict<ferrari09<3, double, wendland_c2>>(M);
    EXPECT_EQ(text == "", TypeParam::value == fault::none) << "M=" << M << ": " << text;
  }
}

TYPED_TEST(broken_backends_test, one_wrong_pair_is_rejected_by_counting) {
  for (const int M : {2, 4, 6}) {
    const std::string text = this->template verdict<count<3, double>>(M);
    EXPECT_EQ(text == "", TypeParam::value == fault::none) << "M=" << M << ": " << text;
  }
}

}  // namespace
}  // namespace pairsum
