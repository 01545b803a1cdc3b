#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/random.hpp>
#include <pairsum/grid/counting_sort.hpp>
#include <pairsum/grid/hashed_grid.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>
#include "harness/gbench/bench.hpp"

namespace pairsum::harness {
namespace {

constexpr std::size_t items = 1 << 16;

template <template <int, class> class Smoothing>
void smoothing(benchmark::State& state) {
  const Smoothing<3, double> W(1.0);
  std::vector<double> r(items);
  const counter_random random(1);
  for (std::size_t i = 0; i < items; ++i) r[i] = random.uniform(i);
  for (auto _ : state)
    for (const double a : r) benchmark::DoNotOptimize(W.slope_over_r(a));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * items));
}

void hashing(benchmark::State& state, int M) {
  const initial_condition c = make_case("lattice", {.dx = 0.025, .H = 0, .state = "perturbed", .seed = 1});
  particle_set<3, double> p;
  fill(p, c.particles);
  const box<3, double> omega{{0, 0, 0}, {1, 1, 1}};
  const hashed_grid<3, double> grid(omega, c.H, M);
  std::vector<std::uint32_t> keys(p.size());
  for (auto _ : state) {
    grid.keys(p, 0, p.size(), keys);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * p.size()));
}

void sorting(benchmark::State& state, int bits) {
  std::vector<std::uint32_t> keys(1 << 20);
  const counter_random random(2);
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = static_cast<std::uint32_t>(random.bits(i) >> (64 - bits));
  counting_sort sort;
  for (auto _ : state) sort.sort(keys, bits, team());
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * keys.size()));
}

}  // namespace

void register_parts() {
  benchmark::RegisterBenchmark("smoothing/wendland_c2", smoothing<wendland_c2>);
  for (const int M : {6, 7, 9})
    benchmark::RegisterBenchmark(fmt::format("hashing/M:{}", M).c_str(), [M](benchmark::State& s) { hashing(s, M); });
  for (const int bits : {12, 18, 21, 27})
    benchmark::RegisterBenchmark(fmt::format("counting_sort/bits:{}", bits).c_str(),
                                 [bits](benchmark::State& s) { sorting(s, bits); });
}

}  // namespace pairsum::harness
