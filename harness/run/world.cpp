#include "harness/run/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include <pairsum/core/granularity.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/check.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/measure/memory.hpp"
#include "harness/measure/pass_times.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/model/cost.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/rows/add_thread_times.hpp"
#include "harness/rows/threads_worked.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/run/step_of_ranks.hpp"
#include "harness/terminal/interrupt.hpp"

namespace pairsum::harness {

namespace {

/// The particles of a request, whose files each rank finds made.
particles_of_request made_in_turn(const run_request& r, const point& any) {
  particles_of_request made;
  here().in_turn([&] { made = initial_of(r, any.dx, any.state); });
  return made;
}

}  // namespace

world_particles::world_particles(const run_request& r, const point& any) : made(made_in_turn(r, any)) {
  if (r.outside == "drop") dropped = drop_outside(made.initial.particles, setup_of(initial));
  for (const std::string& order : r.orders) orders[order] = memory_order(order, initial, r.seed);
}

world::world(const measuring& with, const run_request& r, const point& any,
             std::shared_ptr<const world_particles> particles)
    : with_(with), request_(r), any_(any), particles_(std::move(particles)) {
  with_.all.make_summation(setup_of_point(any, particles_->initial))->check(particles_->initial.particles);
}

/// Everything that particles, reference and trajectory depend on, and the build.
std::string world::key() const {
  return nlohmann::json{with_.build,    request_.case_name, request_.dim,  request_.H, request_.outside,
                        request_.seed,  request_.dt,        any_.dx,       any_.state, particles_->made.hash,
                        any_.precision, any_.interaction,   any_.smoothing}
      .dump();
}

void world::make_reference() {
  // Ranks that wait for the first need their cores.
  const int cores = std::max(1, usable_cores() - here().size() + 1);
  const worker_team workers(runtime::omp, untimed_threads(cores), &with_.binding);
  verifier_ = std::make_unique<verifier>(with_.all, setup_of_point(any_, particles_->initial),
                                         particles_->initial.particles, workers.get(), with_.store, key());
  recall_work();
}

void world::recall_work() {
  const auto bytes = with_.store == nullptr ? std::nullopt : with_.store->load(key() + "/work");
  const std::string kept = here().told(bytes.value_or(""));
  if (kept.empty()) return;
  const nlohmann::json counted = nlohmann::json::parse(kept);  // items() does not keep it
  for (const auto& item : counted.items()) work_[item.key()] = item.value().get<work_row>();
}

void world::remember() {
  if (with_.store == nullptr) return;
  verifier_->remember();
  with_.store->save(key() + "/work", nlohmann::json(work_).dump());
}

void world::complete(point& p) const {
  p.H = particles_->initial.H;
  p.particles = particles_->made.hash;
  p.n_fluid = particles_->initial.particles.count(particle_kind::fluid);
  p.n_boundary = particles_->initial.particles.count(particle_kind::boundary);
}

work_row world::work_of(const point& p, summation& s) {
  const auto [at, is_new] =
      work_.try_emplace(fmt::format("{} {} {} {} {} {} {}", p.backend, p.grid, p.M, p.block, p.isa, p.ranks, p.cut));
  if (is_new) {
    const work_counts w = s.count_work();
    if (!unfolded_) unfolded_ = s.count_unfolded_tests();
    at->second = {w.cells,
                  w.cells_nonempty,
                  w.sumF1,
                  w.sumF2,
                  w.pairs_tested,
                  w.pairs_interacting(),
                  w.pairs_fluid_fluid,
                  w.pairs_fluid_boundary,
                  {}};
    const std::size_t lanes = s.lanes();
    if (s.block() != no_block || lanes > 1) {
      const std::uint64_t vectors = w.vectors_of(lanes);
      const double room = static_cast<double>(lanes * vectors);
      at->second.vector_units = {s.block(), lanes, vectors,
                                 room > 0 ? static_cast<double>(w.fluid_evaluated()) / room : 0};
    }
    if (!costs_) costs_ = with_.all.make_reference(setup_of_point(any_, particles_->initial))->costs();
    const cost_bound bound =
        bound_of({*costs_, s.traits(), w, p.n_fluid, p.n_boundary, with_.last_level_cache_bytes, {}});
    at->second.flops = bound.flops;
    at->second.bytes = bound.bytes;
    if (unfolded_) at->second.pairs_tested_unfolded = s.traits().symmetric ? unfolded_->symmetric : unfolded_->gather;
  }
  return at->second;
}

namespace {

/// Is `a` a worse outcome than `b`: wrong where b is right, or nearer to its bound? A step is as good as its worst
/// stage.
bool worse(const verifier::outcome& a, const verifier::outcome& b) {
  if (a.ok != b.ok) return !a.ok;
  return a.max_rel_err * b.bound > b.max_rel_err * a.bound;
}

void add_to(std::optional<thread_times>& a, const thread_times& b) {
  if (!a) a.emplace();
  harness::add_to(*a, b);
}

void add_to(std::optional<std::uint64_t>& a, const std::optional<std::uint64_t>& b) {
  if (b) a = a.value_or(0) + *b;
}

void add_to(std::optional<counters_row>& a, const counters::counts& b) {
  if (!b.cycles && !b.instructions && !b.cache_misses) return;
  if (!a) a.emplace();
  add_to(a->cycles, b.cycles);
  add_to(a->instructions, b.instructions);
  add_to(a->cache_misses, b.cache_misses);
}

std::string too_large(double dt) { return fmt::format("dt is too large ({:g} s)", dt); }

std::string and_more(std::size_t others) { return others == 0 ? "" : fmt::format(" and {} more", others); }

/// What is wrong with the state that was summed last, "" if nothing is.
/// @param lost how many particles left Omega
std::string fault_of(const summation& s, std::size_t lost, const run_request& r) {
  if (const auto ids = s.not_finite(); !ids.empty())
    return fmt::format("a position, velocity or density of particle {}{} is not finite: {}", ids.front(),
                       and_more(ids.size() - 1), too_large(r.dt));
  if (lost == 0 || r.outside == "drop") return "";
  const auto kinds = s.snapshot().kind;
  return fmt::format(
      "particle {}{} left Omega: {}, or the steps are too many; --outside drop goes on without those "
      "that leave",
      std::ranges::find(kinds, particle_kind::lost) - kinds.begin(), and_more(lost - 1), too_large(r.dt));
}

std::optional<std::uint64_t> growth(std::uint64_t before, const std::optional<std::uint64_t>& now) {
  return now ? std::optional(*now > before ? *now - before : 0) : std::nullopt;
}

}  // namespace

world::result world::measure(const point& p, int steps) {
  result out;
  const auto summation = here().share(with_.all.make_summation(setup_of_point(p, particles_->initial)), p.cut);
  const runtime kind = summation->traits().threads;
  const placement places = place(with_.seats, p.threads);
  if (here().size() > 1) out.untimed = places.why_untimed;
  const worker_team workers(kind, p.threads, &with_.binding,
                            static_cast<int>(places.first[static_cast<std::size_t>(here().rank())]));
  const team t = workers.get().with(parse_granularity(p.granularity, kind));
  const integrator_entry& integrator = find_integrator(p.integrator);
  reset_peak_rss();
  summation->load(particles_->initial.particles, particles_->orders.at(p.order), t);
  int evaluations = 0;
  std::size_t lost = 0;
  for (int step = 1; step <= (steps > 0 ? steps : request_.steps) && out.error.empty(); ++step) {
    if (interrupted()) {
      out.interrupted = true;
      break;
    }
    step_result now;
    phases& times = now.times;
    step_of_ranks together(with_.seats, places, p.threads);
    double checking = 0;
    int evaluations_of_step = 0;
    const auto evaluate = [&] {
      if (out.bad_state) return;  // a later stage
      pass_times passes(p.threads);
      summation->observe(&passes);
      stopwatch clock;
      here().barrier();
      checking += clock.lap();
      summation->index(t);
      times.index_s = times.index_s.value_or(0) + clock.lap();
      const auto held_before = evaluations == 0 ? heap_bytes() : std::nullopt;
      checking += clock.lap();
      summation->prepare(t);
      times.prepare_s = times.prepare_s.value_or(0) + clock.lap();
      summation->zero(t);
      times.zero_s = times.zero_s.value_or(0) + clock.lap();
      with_.hardware.start();
      checking += clock.lap();
      summation->sum(t);
      const double sum_s = clock.lap();
      times.sum_s = times.sum_s.value_or(0) + sum_s;
      add_to(now.counted, with_.hardware.stop());
      checking += clock.lap();
      double waiting_s = 0;
      if (here().size() > 1) {
        here().barrier();
        waiting_s = clock.lap();
      }
      summation->reduce(t);
      times.reduce_s = times.reduce_s.value_or(0) + clock.lap();
      if (held_before) out.workspace_bytes = growth(*held_before, heap_bytes());
      together.add(*summation, sum_s, waiting_s);
      if (passes.any()) {
        add_to(now.threads_busy_s, passes.busy());
        add_to(now.barrier_wait_s, passes.waiting());
      }
      summation->observe(nullptr);
      out.peak_rss_bytes = peak_rss_bytes();
      if (out.error = fault_of(*summation, summation->lost(), request_); !out.error.empty()) {
        out.bad_state = true;
        return;
      }
      const verifier::outcome checked = verifier_->check(*summation, {p.integrator, ++evaluations}, t);
      if (evaluations_of_step++ == 0 || worse(checked, now.checked)) now.checked = checked;
      if (evaluations == 1) out.work = work_of(p, *summation);
      checking += clock.lap();
    };
    stopwatch whole;
    integrator.step(*summation, request_.dt, particles_->initial.gravity, evaluate, t);
    times.total_s = whole.lap() - checking;
    const double evaluated =
        *times.index_s + *times.prepare_s + *times.zero_s + *times.sum_s + *times.reduce_s + together.waiting_s();
    times.integrate_s = std::max(0.0, *times.total_s - evaluated);
    now.ranks = together.end(times);
    const std::size_t lost_before = std::exchange(lost, summation->lost());
    now.lost = lost - lost_before;
    if (kind == runtime::serial) now.threads_worked = 1;
    if (now.threads_busy_s) now.threads_worked = threads_worked(*now.threads_busy_s);
    if (now.ranks) {
      now.threads_busy_s = now.barrier_wait_s = std::nullopt;  // which are of one process
      now.threads_worked = sum_of_ranks(now.threads_worked);
      now.counted = sum_of_ranks(now.counted);
    }
    if (!now.checked.ok) {
      out.bad_state = !now.checked.finite && evaluations > 1;  // what is wrong at the start is no matter of dt
      out.error = now.checked.error + (out.bad_state ? ": " + too_large(request_.dt) : "");
    }
    if (!out.error.empty()) out.error = fmt::format("step {}: {}", step, out.error);
    out.steps.push_back(std::move(now));
  }
  out.peak_rss_bytes = largest_of_ranks(out.peak_rss_bytes);
  out.workspace_bytes = largest_of_ranks(out.workspace_bytes);
  return out;
}

}  // namespace pairsum::harness
