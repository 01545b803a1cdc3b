#include "harness/run/point_setup.hpp"

#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/plan/plan.hpp"

namespace pairsum::harness {
namespace {

/// What blocks of cells are chosen by: a core's own cache, 0 if it is not known, and how many cores there are.
void fit_to_machine(setup& s) {
  static const machine here = describe_machine();
  const auto cache = here.caches.find("L2");
  s.cache_bytes = cache == here.caches.end() ? 0 : static_cast<std::size_t>(cache->second);
  s.cores = static_cast<std::size_t>(here.cores);
}

/// The words of a point, in the world of `s`.
setup named(const point& p, setup s) {
  s.backend = p.backend;
  s.interaction = p.interaction;
  s.smoothing = p.smoothing;
  s.precision = p.precision;
  s.grid = p.grid;
  if (p.M > 0) s.M = p.M;
  s.isa = p.isa;
  if (p.block != no_block) s.block = p.block;
  fit_to_machine(s);
  return s;
}

}  // namespace

setup setup_of_point(const point& p, const initial_condition& c) { return named(p, setup_of(c)); }

bool M_fits(int M, const std::string& backend, const initial_condition& c, const registry& all) {
  setup s = with_skin(setup_of(c), all.find_backend(backend).traits.skin);
  s.grid = "hashed_grid";
  s.M = M;
  return grid_fits(s);
}

verify_plan verify_plan_of(const run_request& r, const registry& all) {
  verify_plan plan;
  for (const world_plan& points : expand(r, all)) {
    plan.emplace_back();
    for (const point& p : points) plan.back().push_back({named(p, {}), p.threads});
  }
  return plan;
}

}  // namespace pairsum::harness
