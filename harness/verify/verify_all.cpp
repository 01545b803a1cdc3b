#include "harness/verify/verify_all.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include <pairsum/sum/setup_of.hpp>
#include "harness/measure/worker_team.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/verify/verifier.hpp"

namespace pairsum::harness {
namespace {

std::string compare_counts(const work_counts& w, const expectation& e) {
  if (w.pairs_fluid_fluid == e.pairs_fluid_fluid && w.pairs_fluid_boundary == e.pairs_fluid_boundary) return {};
  return fmt::format("sums {} fluid-fluid and {} fluid-boundary pairs, the reference {} and {}", w.pairs_fluid_fluid,
                     w.pairs_fluid_boundary, e.pairs_fluid_fluid, e.pairs_fluid_boundary);
}

verify_line check_one(const registry& r, const initial_condition& c, const setup& s, int threads,
                      const std::string& cut, verifier& oracle, std::map<std::string, std::uint64_t>& bits) {
  verify_line line{s, threads, cut, true, 0, {}};
  const auto summation = here().share(r.make_summation(s), cut);
  const worker_team workers(summation->traits().threads, threads);
  summation->load(c.particles, {});
  summation->evaluate(workers.get());
  const verifier::outcome o = oracle.check(*summation, {}, workers.get());
  line.ok = o.ok;
  line.error = o.error;
  if (o.bound > 0) line.share = o.max_rel_err / o.bound;
  const work_counts counted = summation->count_work();
  const std::string counts =
      here().told(here().is_first() ? compare_counts(counted, oracle.initial_expectation()) : "");
  if (line.ok && !counts.empty()) line.error = counts;
  const auto [known, is_new] =
      bits.emplace(fmt::format("{} {} {} {} {} {}", s.backend, s.grid, s.M, s.isa, s.block, cut), o.fingerprint);
  if (line.error.empty() && summation->traits().deterministic && !is_new && known->second != o.fingerprint)
    line.error = "claims equal bits for every number of threads, but they differ";
  line.ok = line.error.empty();
  return line;
}

/// The words of `s` in the world of the case.
setup in_world(setup s, const initial_condition& c) {
  const setup world = setup_of(c);
  s.dim = world.dim;
  s.omega_low = world.omega_low;
  s.omega_high = world.omega_high;
  s.periodic = world.periodic;
  s.constants = world.constants;
  return s;
}

/// Every sum of one formula.
bool verify_formula(const registry& r, const initial_condition& c, const std::vector<verify_sum>& sums,
                    const std::function<void(const verify_line&)>& report) {
  bool all_ok = true;
  int most = 1;
  for (const verify_sum& sum : sums) most = std::max(most, sum.threads);
  const worker_team all(runtime::omp, most);
  verifier oracle(r, in_world(sums.front().words, c), c.particles, all.get());
  std::map<std::string, std::uint64_t> bits;
  for (const verify_sum& sum : sums) {
    const verify_line line = check_one(r, c, in_world(sum.words, c), sum.threads, sum.cut, oracle, bits);
    all_ok = all_ok && line.ok;
    report(line);
  }
  return all_ok;
}

}  // namespace

bool verify_all(const registry& r, const initial_condition& c, const verify_plan& plan,
                const std::function<void(const verify_line&)>& report) {
  bool all_ok = true;
  for (const auto& sums : plan) all_ok = verify_formula(r, c, sums, report) && all_ok;
  return all_ok;
}

}  // namespace pairsum::harness
