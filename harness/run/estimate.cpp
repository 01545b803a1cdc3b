#include "harness/run/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/memory.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/measure/stopwatch.hpp"

namespace pairsum::harness {
namespace {

/// Particles of a case at a spacing; from two coarser ones, as an inside and a surface, where making it would take
/// long. What is too large for ids or memory is made, which refuses it at once.
double particles_of(const run_request& r, double dx) {
  if (!r.particles.empty()) return static_cast<double>(initial_of(r, dx, state_of_files).initial.particles.size());
  constexpr double fine = 0.025, full = 0.95, most_ids = 4e9;
  const auto made = [&](double spacing) {
    return static_cast<double>(make_case(r.case_name, {r.dim, spacing, r.H, "rest", r.seed}).particles.size());
  };
  if (!(dx < fine)) return made(dx);
  const double n = made(fine), inside = 2 * (n - std::ldexp(made(2 * fine), r.dim - 1));
  const double estimated = inside * std::pow(fine / dx, r.dim) + (n - inside) * std::pow(fine / dx, r.dim - 1);
  const bool may_fit = estimated < full * std::min(most_ids, usable_memory() / bytes_per_particle);
  return may_fit ? estimated : made(dx);
}

/// How many times as many pairs as at H = 2 dx a particle has, about; the rest of a step costs a quarter of those.
double more_pairs(const run_request& r, double dx) {
  const double H = r.particles.empty() ? r.H : initial_of(r, dx, state_of_files).initial.H;
  return H > 0 ? std::max(0.25, std::pow(H / (2 * dx), r.dim)) : 1;
}

}  // namespace

estimate::estimate(const study_plan& plan, const registry& all) : budget_s_(plan.budget_s) {
  const int cores = usable_cores();
  for (const part_plan& part : plan.parts) {
    part_estimate e;
    e.rounds = part.half_width > 0 ? part.least_rounds : part.most_rounds;
    std::map<double, double> particles;  // each counted as often as it has more pairs
    for (const world_plan& points : expand(part.request, all))
      for (const point& p : points) {
        auto [at, is_new] = particles.try_emplace(p.dx);
        if (is_new) at->second = particles_of(part.request, p.dx) * more_pairs(part.request, p.dx);
        e.work += at->second * part.request.steps * part.request.repetitions * plan.builds / std::min(p.threads, cores);
        ++e.points;
      }
    parts_.push_back(e);
  }
  if (plan.peaks) peaks_s_ = 1.2 * static_cast<double>(peaks_of(plan, all).size());
}

void estimate::calibrate(const registry& all) {
  // Whatever formula was built, in the most dimensions; some thousands of particles.
  const std::vector<combination> built = all.formulas();
  const combination f = *std::ranges::find(built, all.dims().back(), &combination::dim);
  const double dx = f.dim == 3 ? 0.03 : f.dim == 2 ? 0.004 : 0.0002;
  const initial_condition c = make_case(f.dim == 1 ? "lattice" : "dam_break", {f.dim, dx, 0, "rest", 1});
  setup s = setup_of(c);
  s.precision = f.precision;
  s.interaction = f.interaction;
  s.smoothing = f.smoothing;
  s.backend = all.backends().front().traits.name;
  const auto sum = all.make_summation(s);
  const workers w(sum->traits().threads, 1);
  sum->load(c.particles, {});
  sum->evaluate(w.get());
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5; ++k) {
    stopwatch clock;
    sum->evaluate(w.get());
    best = std::min(best, clock.seconds());
  }
  rate_ = best / static_cast<double>(c.particles.size());
}

double estimate::all_s() const {
  double all = peaks_s_;
  for (std::size_t k = 0; k < parts_.size(); ++k) all += verify_s(k) + parts_[k].rounds * round_s(k);
  return budget_s_ > 0 ? std::min(all, budget_s_) : all;
}

void estimate::verified(std::size_t part, double seconds) {
  parts_[part].verify_s = seconds;
  rate_ = std::max(1e-9, (seconds / verify_factor - 0.3) / parts_[part].work);
}

void estimate::measured(std::size_t part, double seconds) {
  parts_[part].round_s = seconds;
  rate_ = std::max(1e-9, (seconds / round_factor - 0.3) / parts_[part].work);
}

}  // namespace pairsum::harness
