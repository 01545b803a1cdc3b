#include "harness/evolve/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

/// Faster than so many times sound at rest nothing flows that this equation of state describes.
constexpr double apart = 10;

/// The rows of particles that are not lost, and their ids of the start.
void keep_rows(particle_table& p, std::vector<std::uint32_t>& ids) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] == particle_kind::lost) continue;
    for (std::size_t d = 0; d < p.x.size(); ++d) p.x[d][kept] = p.x[d][i], p.v[d][kept] = p.v[d][i];
    p.rho[kept] = p.rho[i];
    p.m[kept] = p.m[i];
    p.kind[kept] = p.kind[i];
    ids[kept++] = ids[i];
  }
  p.resize(kept);
  ids.resize(kept);
}

}  // namespace

moment start_of(const particle_table& p) {
  moment m{p, std::vector<std::uint32_t>(p.size()), 0, 0, 0, 0};
  std::iota(m.ids.begin(), m.ids.end(), 0u);
  return m;
}

simulation::simulation(std::unique_ptr<summation> sum, const initial_condition& domain, moment start,
                       const step_rules& rules, const team& t, const crew& ranks)
    : sum_(std::move(sum)),
      domain_(domain),
      now_(std::move(start)),
      rules_(rules),
      integrator_(find_integrator(rules.integrator)),
      team_(t),
      ranks_(ranks) {
  sum_->load(now_.particles, {}, team_);
}

void simulation::fail(const std::string& what) const {
  throw error(fmt::format("step {} (t = {:.6g} s, dt = {:.3g} s): {}", now_.step, now_.t, last_dt_, what));
}

extremes simulation::extremes_now() {
  const extremes own = extremes_of(*sum_, domain_.gravity, team_);
  if (ranks_.size() == 1) return own;
  std::vector<extremes> all;
  const std::vector<double> numbers{own.speed, own.acceleration, own.density, static_cast<double>(own.fastest),
                                    own.finite ? 1.0 : 0.0};
  for (const std::vector<double>& n : ranks_.gather(numbers))
    all.push_back({n[0], n[1], n[2], static_cast<std::uint32_t>(n[3]), n[4] > 0});
  return largest_of(all);
}

void simulation::step(double end) {
  if (rules_.dt > 0) now_.next_dt = rules_.dt;
  if (now_.next_dt == 0) {  // the first step, before any rate is known
    extremes start = extremes_now();
    start.acceleration = domain_.gravity;
    now_.next_dt = time_step(start, domain_.H, domain_.eos, rules_.cfl);
  }
  const bool ends = now_.t + now_.next_dt >= end;
  last_dt_ = ends ? end - now_.t : now_.next_dt;
  integrator_.step(
      *sum_, last_dt_, domain_.gravity, [&] { sum_->evaluate(team_); }, team_);
  now_.t = ends ? end : now_.t + last_dt_;
  ++now_.step;
  const extremes e = extremes_now();
  constexpr const char* smaller = "; a smaller --dt or --cfl may hold it";
  if (!e.finite) {
    const auto bad = sum_->not_finite();
    fail(fmt::format("a position, velocity or density of particle {} is not finite{}",
                     bad.empty() ? 0 : now_.ids[bad.front()], smaller));
  }
  if (e.speed > apart * domain_.eos.sound_speed0())
    fail(fmt::format("particle {} moves at {:.4g} m/s, more than {:g} times sound: the fluid flies apart{}",
                     now_.ids[e.fastest], e.speed, apart, smaller));
  if (!rules_.drop && sum_->lost() > 0) {
    const auto kinds = sum_->snapshot().kind;
    const auto first = std::ranges::find(kinds, particle_kind::lost) - kinds.begin();
    fail(fmt::format("particle {} left Omega; --outside drop goes on without those that leave",
                     now_.ids[static_cast<std::size_t>(first)]));
  }
  now_.next_dt = rules_.dt > 0 ? rules_.dt : time_step(e, domain_.H, domain_.eos, rules_.cfl);
}

moment simulation::look() const {
  moment m{sum_->snapshot(), now_.ids, now_.t, now_.step, now_.next_dt, lost()};
  return m;
}

moment simulation::save() {
  sum_->index(team_);  // who left Omega in this step is lost from now on
  now_.lost += sum_->lost();
  now_.particles = sum_->snapshot();
  keep_rows(now_.particles, now_.ids);
  sum_->load(now_.particles, {}, team_);
  return now_;
}

}  // namespace pairsum::harness
