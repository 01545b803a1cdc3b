#pragma once
#include <rapidcheck.h>

#include <algorithm>

#include "cloud.hpp"

// RapidCheck's generators of clouds and formulas.
namespace rc {
template <>
struct Arbitrary<pairsum::test_kit::cloud> {
  static Gen<pairsum::test_kit::cloud> arbitrary() {
    using pairsum::test_kit::cloud;
    return gen::build<cloud>(
        gen::set(&cloud::dim, gen::elementOf(pairsum::registry::instance().dims())),
        gen::set(&cloud::form, gen::elementOf(pairsum::test_kit::shapes)),
        gen::set(&cloud::fluid, gen::inRange(0u, 200u)), gen::set(&cloud::boundary, gen::inRange(0u, 100u)),
        gen::set(&cloud::length, gen::element(0.4, 1.0, 2.5, 4.0, 7.3, 20.0)),
        gen::set(&cloud::corner, gen::element(0.0, -0.5, 3.7, -1e3, 1e6, -1e9)),
        gen::set(&cloud::H, gen::element(0.1, 1.0, 0.01188, 50.0)), gen::set(&cloud::M, gen::inRange(2, 6)),
        gen::set(&cloud::seed, gen::inRange(1, 1000000)),
        gen::set(&cloud::grid, gen::element<std::string>("hashed_grid", "hashed_grid", "dense_grid", "compact_grid")));
  }
};
}  // namespace rc

namespace pairsum::test_kit {

/// Has a cloud a fluid particle on a boundary particle, in that precision? monaghan94 refuses such.
inline bool touching(const particle_table& p, const std::string& precision) {
  const auto same = [&](double a, double b) {
    return precision == "float" ? static_cast<float>(a) == static_cast<float>(b) : a == b;
  };
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (p.kind[i] != particle_kind::fluid || p.kind[j] != particle_kind::boundary) continue;
      bool all = true;
      for (const auto& x : p.x) all = all && same(x[i], x[j]);
      if (all) return true;
    }
  return false;
}

/// A formula of this build that the backend takes: `count`, or any other.
inline rc::Gen<formula_choice> some_formula(const std::string& backend, bool counts) {
  std::vector<formula_choice> all = formulas();
  std::erase_if(all, [&](const formula_choice& f) {
    return (f.interaction == "count") != counts || std::ranges::count(backends_for(f), backend) == 0;
  });
  return rc::gen::elementOf(all);
}

}  // namespace pairsum::test_kit
