#include "harness/tune/bench.hpp"

#include <algorithm>
#include <cmath>

#include <pairsum/core/error.hpp>
#include <pairsum/core/granularity.hpp>
#include "harness/environment/machine.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/plan/variants.hpp"
#include "harness/run/point_setup.hpp"

namespace pairsum::harness {
namespace {

constexpr double least_timed_s = 0.02;  ///< of a measurement, so that the clock and a late thread weigh little
constexpr int most_evaluations = 50;

}  // namespace

tune_bench::tune_bench(const tune_request& r, const point& any, const registry& all)
    : request_(r), all_(all), binding_(r.binding), particles_(r.levels, any) {}

void tune_bench::leave_out_M_that_do_not_fit(std::vector<point>& points) const {
  if (!particles_.initial.periodic.any()) return;
  std::erase_if(points, [&](const point& p) { return p.M > 0 && !M_fits(p.M, p.backend, particles_.initial, all_); });
  if (points.empty())
    throw error("none of the M that are tried goes round the periodic box: name some with --M, or another --grid");
}

void tune_bench::leave_out_wide_skins(std::vector<point>& points) const {
  if (request_.levels.backends != available_backends(all_)) return;
  const std::vector<std::string> wide = wide_skins(particles_.initial, all_);
  std::erase_if(points, [&](const point& p) { return std::ranges::find(wide, p.backend) != wide.end(); });
}

void tune_bench::check_input(const point& p) const {
  all_.make_summation(setup_of_point(p, particles_.initial))->check(particles_.initial.particles);
}

void tune_bench::complete(point& p) const {
  p.H = particles_.initial.H;
  p.n_fluid = particles_.initial.particles.count(particle_kind::fluid);
  p.n_boundary = particles_.initial.particles.count(particle_kind::boundary);
}

void tune_bench::make_reference(const point& p) {
  auto& v = verifiers_[p.precision];
  if (v) return;
  const worker_team workers(runtime::omp, untimed_threads(usable_cores()), &binding_);
  v = std::make_unique<verifier>(all_, setup_of_point(p, particles_.initial), particles_.initial.particles,
                                 workers.get());
}

std::optional<double> tune_bench::evaluate(summation& s, const point& p, const team& t, std::string& error) {
  stopwatch clock;
  s.index(t);
  s.prepare(t);
  s.zero(t);
  const double before = clock.lap();
  s.sum(t);
  const double sum = clock.lap();
  s.reduce(t);
  const double after = clock.lap();
  const verifier::outcome checked = verifiers_.at(p.precision)->check(s, {}, t);
  if (!checked.ok) {
    error = checked.error;
    return std::nullopt;
  }
  return request_.phase == "sum" ? sum : before + sum + after;
}

std::optional<double> tune_bench::measure(const point& p, std::string& error) {
  make_reference(p);
  const auto s = all_.make_summation(setup_of_point(p, particles_.initial));
  const runtime kind = s->traits().threads;
  const worker_team workers(kind, p.threads, &binding_);
  const team t = workers.get().with(parse_granularity(p.granularity, kind));
  const auto load = [&] { s->load(particles_.initial.particles, particles_.orders.at(p.order), t); };
  load();
  if (!evaluate(*s, p, t, error)) return std::nullopt;
  double all = 0;
  int evaluations = 0;
  while (evaluations == 0 || (all < least_timed_s && evaluations < most_evaluations)) {
    load();  // or lists that are kept from step to step would never be made in time that counts
    for (int step = 0; step < request_.levels.steps; ++step, ++evaluations) {
      const auto seconds = evaluate(*s, p, t, error);
      if (!seconds) return std::nullopt;
      all += *seconds;
    }
  }
  return std::max(1e-9, all / evaluations);
}

}  // namespace pairsum::harness
