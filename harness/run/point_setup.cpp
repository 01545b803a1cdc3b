#include "harness/run/point_setup.hpp"

#include "harness/environment/machine.hpp"
#include "harness/plan/plan.hpp"
#include "sum/setup_of.hpp"

namespace pairsum::harness {
namespace {

/// Of a core's own cache, which blocks are to fit into; 0 if it is not known.
std::size_t core_cache_bytes() {
  static const std::size_t bytes = [] {
    const auto caches = describe_machine().caches;
    const auto at = caches.find("L2");
    return at == caches.end() ? std::size_t{0} : static_cast<std::size_t>(at->second);
  }();
  return bytes;
}

/// The words of a point, in the world of `s`.
setup named(const point& p, setup s, const registry& all) {
  s.backend = p.backend;
  s.interaction = p.interaction;
  s.smoothing = p.smoothing;
  s.precision = p.precision;
  s.grid = p.grid;
  if (p.M > 0) s.M = p.M;
  if (all.find_backend(p.backend).traits.vector) s.isa = p.isa;
  if (p.block != no_block) s.block = p.block;
  s.cache_bytes = core_cache_bytes();
  return s;
}

}  // namespace

setup setup_of_point(const point& p, const initial_condition& c, const registry& all) {
  return named(p, setup_of(c), all);
}

verify_plan verify_plan_of(const run_request& r, const registry& all) {
  verify_plan plan;
  for (const world_plan& points : expand(r, all)) {
    plan.emplace_back();
    for (const point& p : points) plan.back().push_back({named(p, {}, all), p.threads});
  }
  return plan;
}

}  // namespace pairsum::harness
