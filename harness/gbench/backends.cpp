#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/gbench/bench.hpp"
#include "harness/measure/binding.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/verify/verifier.hpp"

namespace pairsum::harness {
namespace {

/// The only one of the process, which comes before any thread is bound.
const thread_binding& binding_of(const bench_request& r) {
  static const thread_binding the_one(r.binding);
  return the_one;
}

/// Particles and reference, made when the first benchmark needs them.
struct shared_world {
  initial_condition initial;
  std::unique_ptr<verifier> oracle;

  explicit shared_world(const bench_request& r)
      : initial(initial_of(r.levels, r.levels.dx.front(), r.levels.states.front()).initial) {
    const worker_team all(runtime::omp, untimed_threads(usable_cores()), &binding_of(r));
    oracle = std::make_unique<verifier>(registry::instance(), setup_of(initial), initial.particles, all.get());
  }
};

bool any_refused = false;

shared_world& world_of(const bench_request& r) {
  static shared_world the_one(r);
  return the_one;
}

void sum_benchmark(benchmark::State& state, const bench_request& r, const point& p) {
  shared_world& w = world_of(r);
  const auto summation = registry::instance().make_summation(setup_of_point(p, w.initial));
  const worker_team workers(summation->traits().threads, p.threads, &binding_of(r));
  const team& t = workers.get();
  summation->load(w.initial.particles, {});
  summation->evaluate(t);
  const auto outcome = w.oracle->check(*summation, {}, t);
  if (!outcome.ok) {
    any_refused = true;
    state.SkipWithError(outcome.error.c_str());
    return;
  }
  const work_counts work = summation->count_work();
  double index = 0, prepare = 0;
  for (auto _ : state) {
    stopwatch clock;
    summation->index(t);
    index += clock.lap();
    summation->prepare(t);
    prepare += clock.lap();
    summation->zero(t);
    clock.lap();
    summation->sum(t);
    summation->reduce(t);
    state.SetIterationTime(clock.lap());
  }
  using counter = benchmark::Counter;
  const double n = static_cast<double>(state.iterations()), pairs = static_cast<double>(work.pairs_interacting());
  state.counters["index_s"] = index / n;  // which is shown with a prefix of its own, as 2.18m
  state.counters["prepare_s"] = prepare / n;
  state.counters["pairs_tested"] = static_cast<double>(work.pairs_tested);
  state.counters["pairs_interacting"] = pairs;
  state.counters["useful_pair_ratio"] = work.pairs_tested ? pairs / static_cast<double>(work.pairs_tested) : 0;
  state.counters["cells_nonempty"] = static_cast<double>(work.cells_nonempty);
  state.counters["pairs_per_second"] = counter(pairs, counter::kIsIterationInvariantRate);
}

}  // namespace

bool any_failed() { return any_refused; }

std::string register_backends(const bench_request& r) {
  const std::string pinned = binding_of(r).description();
  for (const world_plan& points : expand(r.levels))
    for (const point& p : points) {
      const backend_traits& traits = registry::instance().find_backend(p.backend).traits;
      std::string cells = cells_word(p);
      std::ranges::replace(cells, '=', ':');
      const std::string name = fmt::format("{}/{}/{}/threads:{}{}{}", p.backend, p.case_name, cells, p.threads,
                                           traits.vector == (p.isa != scalar_isa) ? "" : "/isa:" + p.isa,
                                           traits.blocks ? "/block:" + p.block : "");
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) { sum_benchmark(s, r, p); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  return pinned;
}

}  // namespace pairsum::harness
