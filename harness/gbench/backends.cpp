#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>

#include "cases/case.hpp"
#include "harness/environment/machine.hpp"
#include "harness/gbench/bench.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/verify/verifier.hpp"
#include "sum/setup_of.hpp"

namespace pairsum::harness {
namespace {

/// Particles and reference, made when the first benchmark needs them.
struct shared_world {
  initial_condition initial;
  setup base;
  std::unique_ptr<verifier> oracle;

  explicit shared_world(const bench_request& r)
      : initial(make_case(r.case_name, {.dx = r.dx, .H = 0, .state = r.state, .seed = 1})), base(setup_of(initial)) {
    const worker_team all(runtime::omp, usable_cores());
    oracle = std::make_unique<verifier>(registry::instance(), base, initial.particles, all.get());
  }
};

shared_world& world_of(const bench_request& r) {
  static shared_world the_one(r);
  return the_one;
}

void sum_benchmark(benchmark::State& state, const bench_request& r, const std::string& backend, int M, int threads) {
  shared_world& w = world_of(r);
  setup s = w.base;
  s.backend = backend;
  s.M = M;
  const auto summation = registry::instance().make_summation(s);
  const worker_team workers(summation->traits().threads, threads);
  const team& t = workers.get();
  summation->load(w.initial.particles, {});
  summation->evaluate(t);
  const auto outcome = w.oracle->check(*summation, {}, t);
  if (!outcome.ok) {
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
  state.counters["index_ms"] = 1e3 * index / n;
  state.counters["prepare_ms"] = 1e3 * prepare / n;
  state.counters["pairs_tested"] = static_cast<double>(work.pairs_tested);
  state.counters["pairs_interacting"] = pairs;
  state.counters["useful_pair_ratio"] = work.pairs_tested ? pairs / static_cast<double>(work.pairs_tested) : 0;
  state.counters["cells_nonempty"] = static_cast<double>(work.cells_nonempty);
  state.counters["pairs_per_second"] = counter(pairs, counter::kIsIterationInvariantRate);
}

}  // namespace

void register_backends(const bench_request& r) {
  for (const backend_entry& b : registry::instance().backends()) {
    if (!b.unavailable.empty()) continue;
    const std::string name(b.traits.name);
    for (const int M : r.M)
      for (const int threads : r.threads) {
        const bool serial = b.traits.threads == runtime::serial;
        if (serial && threads != r.threads.front()) continue;
        const int used = serial ? 1 : threads;
        benchmark::RegisterBenchmark(fmt::format("{}/{}/M:{}/threads:{}", name, r.case_name, M, used).c_str(),
                                     [=](benchmark::State& s) { sum_benchmark(s, r, name, M, used); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
  }
}

}  // namespace pairsum::harness
