#include "harness/verify/verify_all.hpp"

#include <fmt/format.h>

#include <map>

#include "harness/measure/worker_team.hpp"
#include "harness/verify/verifier.hpp"
#include "sum/setup_of.hpp"

namespace pairsum::harness {
namespace {

std::string compare_counts(const work_counts& w, const expectation& e) {
  if (w.pairs_fluid_fluid == e.pairs_fluid_fluid && w.pairs_fluid_boundary == e.pairs_fluid_boundary) return {};
  return fmt::format("sums {} fluid-fluid and {} fluid-boundary pairs, the reference {} and {}", w.pairs_fluid_fluid,
                     w.pairs_fluid_boundary, e.pairs_fluid_fluid, e.pairs_fluid_boundary);
}

verify_line check_one(const registry& r, const initial_condition& c, const setup& s, int threads, verifier& oracle,
                      std::map<std::string, std::uint64_t>& bits) {
  verify_line line{s.precision, s.interaction, s.smoothing, s.backend, s.M, threads, true, 0, {}};
  const auto summation = r.make_summation(s);
  const worker_team workers(summation->traits().threads, threads);
  summation->load(c.particles, {});
  summation->evaluate(workers.get());
  const verifier::outcome o = oracle.check(*summation, {}, workers.get());
  line.ok = o.ok;
  line.error = o.error;
  if (o.bound > 0) line.share = o.max_rel_err / o.bound;
  const std::string counts = compare_counts(summation->count_work(), oracle.initial_expectation());
  if (line.ok && !counts.empty()) line.error = counts;
  const auto [known, is_new] = bits.emplace(fmt::format("{} {}", s.backend, s.M), o.fingerprint);
  if (line.error.empty() && summation->traits().deterministic && !is_new && known->second != o.fingerprint)
    line.error = "claims equal bits for every number of threads, but they differ";
  line.ok = line.error.empty();
  return line;
}

/// Everything for one precision, interaction and smoothing kernel.
bool verify_formula(const registry& r, const initial_condition& c, setup s, const verify_plan& plan,
                    const std::function<void(const verify_line&)>& report) {
  bool all_ok = true;
  const worker_team all(runtime::omp, plan.threads.back());
  verifier oracle(r, s, c.particles, all.get());
  std::map<std::string, std::uint64_t> bits;
  for (const std::string& backend : plan.backends)
    for (const int M : plan.M)
      for (const int threads : plan.threads) {
        const bool serial = r.find_backend(backend).traits.threads == runtime::serial;
        if (serial && threads != plan.threads.front()) continue;
        s.backend = backend;
        s.M = M;
        const verify_line line = check_one(r, c, s, serial ? 1 : threads, oracle, bits);
        all_ok = all_ok && line.ok;
        report(line);
      }
  return all_ok;
}

}  // namespace

bool verify_all(const registry& r, const initial_condition& c, const verify_plan& plan,
                const std::function<void(const verify_line&)>& report) {
  bool all_ok = true;
  setup s = setup_of(c);
  s.grid = plan.base.grid;
  for (const std::string& backend : plan.backends) r.find_backend(backend);
  for (const std::string& precision : plan.precisions)
    for (const std::string& interaction : plan.interactions)
      for (const std::string& smoothing : plan.smoothings) {
        const bool smoothed = r.is_smoothed(interaction);
        if (!smoothed && smoothing != plan.smoothings.front()) continue;
        s.precision = precision;
        s.interaction = interaction;
        s.smoothing = smoothed ? smoothing : "none";
        all_ok = verify_formula(r, c, s, plan, report) && all_ok;
      }
  return all_ok;
}

}  // namespace pairsum::harness
