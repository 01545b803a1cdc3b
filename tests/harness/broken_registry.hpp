#pragma once
#include "broken_backends.hpp"
#include "interactions/ferrari09.hpp"
#include "smoothing/wendland_c2.hpp"
#include "sum/enrol.hpp"
#include "sum/enrol_oracle.hpp"

namespace pairsum {

/// A registry that holds the talk's passes with planted faults, the sound one among them, and the true references.
inline registry broken_registry() {
  using formula = ferrari09<3, double, wendland_c2>;
  using counting = count<3, double>;
  registry r;
  enrol_oracle<formula>(r);
  enrol_oracle<counting>(r);
  const auto add = [&]<fault F>() {
    using broken = broken_symmetric<F>;
    r.enrol_backend(broken::traits);
    enrol_summation<broken, formula>(r);
    enrol_summation<broken, counting>(r);
  };
  add.template operator()<fault::none>();
  add.template operator()<fault::drop_pair>();
  add.template operator()<fault::double_pair>();
  add.template operator()<fault::flip_sign>();
  return r;
}

}  // namespace pairsum
