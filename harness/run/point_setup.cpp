#include "harness/run/point_setup.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/variants.hpp"

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
  s.constants.dx = p.dx;
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

std::vector<std::string> wide_skins(const initial_condition& c, const registry& all) {
  std::vector<std::string> wide;
  if (!c.periodic.any()) return wide;
  setup s = setup_of(c);
  s.grid = "compact_grid";
  for (const backend_entry& b : all.backends())
    if (b.traits.skin > 0 && grid_fits(s) && !grid_fits(with_skin(s, b.traits.skin))) wide.emplace_back(b.traits.name);
  return wide;
}

std::string leave_out(run_request& r, const std::vector<std::string>& backends, const registry& all) {
  if (backends.empty() || r.backends != available_backends(all)) return "";
  std::erase_if(r.backends, [&](const std::string& backend) {
    run_request one = r;
    one.backends = {backend};
    return std::ranges::find(backends, backend) != backends.end() || expand(one, all).empty();
  });
  return fmt::format("left out: {}; the periodic box has no three cells of H and their skin along an axis\n",
                     join(backends));
}

std::string leave_out_wide_skins(run_request& r, const registry& all) {
  constexpr double coarse = 0.1;
  std::vector<std::string> wide;
  if (r.backends != available_backends(all)) return "";
  try {
    if (r.particles.empty() && !make_case(r.case_name, {.dim = r.dim, .dx = coarse}).periodic.any()) return "";
    for (const double dx : r.dx)
      for (const std::string& backend :
           wide_skins(initial_of(r, dx, r.particles.empty() ? "rest" : state_of_files).initial, all))
        if (std::ranges::find(wide, backend) == wide.end()) wide.push_back(backend);
  } catch (const error&) {
    return "";
  }
  return leave_out(r, wide, all);
}

verify_plan verify_plan_of(const run_request& r, const registry& all) {
  verify_plan plan;
  for (const world_plan& points : expand(r, all)) {
    plan.emplace_back();
    for (const point& p : points) plan.back().push_back({named(p, {}), p.threads, p.cut});
  }
  return plan;
}

}  // namespace pairsum::harness
