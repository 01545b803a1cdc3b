#include "harness/report/evaluations.hpp"

#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

std::optional<double> evaluation_s(const phases& p) {
  double time = 0;
  for (const auto part : {&phases::prepare_s, &phases::zero_s, &phases::sum_s, &phases::reduce_s}) {
    if (!(p.*part)) return std::nullopt;
    time += *(p.*part);
  }
  return time > 0 ? std::optional(time) : std::nullopt;
}

std::vector<double> without_rounds(const round_values& values) {
  std::vector<double> bare;
  for (const auto& [round, value] : values) bare.push_back(value);
  return bare;
}

}  // namespace

round_values evaluations_of(const measured_point& p) {
  round_values values;
  for (const auto& [round, value] : p.rounds) {
    const auto time = evaluation_s(value.mean);
    if (!time) return {};
    values[round] = *time;
  }
  return values;
}

double median_of(const round_values& values) { return median(without_rounds(values)); }

ratio_estimate ratio_of(const round_values& base, const round_values& other) {
  std::vector<double> a, b;
  for (const auto& [round, value] : base)
    if (const auto at = other.find(round); at != other.end()) {
      a.push_back(value);
      b.push_back(at->second);
    }
  return a.empty() ? unpaired_ratio_of(base, other) : paired_ratio(a, b);
}

round_values standing(const round_values& values, const round_values& base) {
  round_values ratios;
  for (const auto& [round, value] : values)
    if (const auto at = base.find(round); at != base.end()) ratios[round] = value / at->second;
  return ratios;
}

ratio_estimate unpaired_ratio_of(const round_values& base, const round_values& other) {
  return unpaired_ratio(without_rounds(base), without_rounds(other));
}

}  // namespace pairsum::harness
