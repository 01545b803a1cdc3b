#include "harness/model/cost.hpp"

#include <algorithm>

namespace pairsum::harness {
namespace {

double flops_of(const cost_question& q) {
  const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
  const pair_flops& pair = q.formula.counted;
  const double evaluations = q.backend.evaluations_per_pair() * number(q.work.pairs_fluid_fluid);
  // The work is counted for boundary particles that act up to H; of others, no number of pairs is known, and of those
  // that do not act at all, no number of tests.
  const double walls = q.formula.boundary_reach >= 1 ? number(q.work.pairs_fluid_boundary) : 0;
  const bool tests_known = q.formula.boundary_reach > 0 || q.n_boundary == 0;
  const double in_sum = evaluations * (q.backend.symmetric ? pair.both : pair.one_sided) + walls * pair.boundary;
  // A listed pair needs its distance, not the comparison.
  if (q.backend.keeps_pairs) return in_sum + (evaluations + walls) * (q.formula.distance_test - 1);
  return in_sum + (tests_known ? number(q.work.pairs_tested) : evaluations) * q.formula.distance_test;
}

double bytes_of(const cost_question& q) {
  const double fluid = static_cast<double>(q.n_fluid), rates = fluid * q.formula.rates_bytes;
  const double read = fluid * q.formula.fluid_bytes, data = read + rates;
  const int sweeps = data > static_cast<double>(q.last_level_cache_bytes) ? q.backend.sweeps(q.formula.dim) : 1;
  const double list = q.backend.keeps_pairs ? static_cast<double>(q.work.pairs_fluid_fluid) * sizeof(std::uint32_t) : 0;
  return q.backend.accumulates() ? sweeps * (read + 2 * rates) + list : sweeps * read + rates + list;
}

}  // namespace

cost_bound bound_of(const cost_question& q) {
  cost_bound b;
  b.flops = flops_of(q);
  b.bytes = bytes_of(q);
  if (b.bytes > 0) b.intensity = b.flops / b.bytes;
  if (!(q.peaks.bandwidth_bytes_per_s > 0 && q.peaks.flops_per_s > 0)) return b;
  const double by_bandwidth = b.bytes / q.peaks.bandwidth_bytes_per_s, by_flops = b.flops / q.peaks.flops_per_s;
  b.bound_s = std::max(by_bandwidth, by_flops);
  b.limited_by = by_flops >= by_bandwidth ? "flops" : "bandwidth";
  return b;
}

std::string contradiction(const backend_traits& declared, const work_counts& counted) {
  const std::uint64_t expected =
      static_cast<std::uint64_t>(declared.evaluations_per_pair()) * counted.pairs_fluid_fluid +
      counted.pairs_fluid_boundary;
  if (counted.pairs_evaluated == expected) return {};
  return std::string(declared.name) + " evaluates the formula " + std::to_string(counted.pairs_evaluated) +
         " times; by its evaluations_per_pair of " + std::to_string(declared.evaluations_per_pair()) + " it would be " +
         std::to_string(expected);
}

}  // namespace pairsum::harness
