#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "harness/verify/compare.hpp"
#include "sum/registry.hpp"

namespace pairsum::harness {

/// Verifies the rates of any backend on the trajectory that starts from one initial state. The reference of that state is computed
/// once (by brute force up to `brute_force_limit` particles, else by the reference's cell search, which is itself checked
/// by brute force on 1000 sampled particles) and kept. Later steps are checked on 64 sampled particles of the state as it is.
/// Rates that are bit-identical to rates verified before, at the same step, need no second look.
class verifier {
 public:
  static constexpr std::size_t brute_force_limit = 20000;

  /// `initial`: the particles that load() gets. Throws pairsum::error if the reference contradicts itself.
  verifier(const registry& r, const setup& s, particle_table initial, const team& t);

  struct outcome {
    bool ok = true;
    std::optional<double> max_rel_err, bound;  ///< empty if the rates were known
    std::uint64_t fingerprint = 0;
    std::string error;
  };

  /// Checks the rates of the evaluation that was made last; `step` counts from 1, step 1 being the initial state.
  outcome check(summation& s, int step, const team& t);

  const expectation& initial_expectation() const { return expected_; }

 private:
  expectation sampled(const particle_table& p, std::size_t n, std::uint64_t seed, const team& t) const;

  std::unique_ptr<reference> reference_;
  particle_table initial_;
  expectation expected_;
  std::set<std::pair<int, std::uint64_t>> known_;
};

}  // namespace pairsum::harness
