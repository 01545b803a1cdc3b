#pragma once
#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <pairsum/sum/registry.hpp>
#include "harness/verify/compare.hpp"
#include "harness/verify/shared_store.hpp"

namespace pairsum::harness {

/// Verifies the rates of any backend on the trajectory that starts from one initial state. The reference of that state
/// is computed once (by brute force up to `brute_force_limit` particles, else by the reference's cell search, which is
/// itself checked by brute force on 1000 sampled particles) and kept. Later steps are checked by brute force on the
/// state as it is: all of its particles up to that limit, 256 sampled ones beyond. Rates that are bit-identical to
/// rates verified before, at the same moment, get the verdict those got.
class verifier {
 public:
  static constexpr std::size_t brute_force_limit = 20000, later_samples = 256;

  /// `initial`: the particles that load() gets. With a `store` the reference and the verdicts of an earlier process are
  /// taken from there, under `key`, which must name the same particles, setup and build; the reference is read when it
  /// is first needed. Throws pairsum::error if the reference contradicts itself.
  verifier(const registry& r, const setup& s, const particle_table& initial, const team& t,
           shared_store* store = nullptr, std::string key = "");

  /// Hands the verdicts to the processes that come later, if there is a store.
  void remember();

  /// Which state of which trajectory: the integrator and the number of evaluations, from 1 at the initial state.
  struct moment {
    std::string integrator;
    int evaluation = 1;
    auto operator<=>(const moment&) const = default;
  };

  struct outcome {
    bool ok = true, finite = true;      ///< finite: the reference is
    double max_rel_err = 0, bound = 0;  ///< of the entry nearest to its bound
    bool known = false;                 ///< recognised by its bits
    std::uint64_t fingerprint = 0;
    std::string error;
  };

  /// Checks the rates of the evaluation that was made last.
  outcome check(summation& s, const moment& when, const team& t);

  /// The reference of the initial state; of several ranks the first alone has it.
  const expectation& initial_expectation();

 private:
  /// What the first rank finds; all ranks hand it their part of the rates.
  verdict judge(summation& s, const moment& when, const team& t);
  expectation reference_of(const particle_table& initial, const team& t) const;
  expectation sampled(const particle_table& p, std::size_t n, std::uint64_t seed, const team& t) const;

  expectation expect_now(const particle_table& p, int evaluation, const team& t) const;

  std::unique_ptr<reference> reference_;
  std::optional<expectation> expected_;  ///< empty until it is needed, if it is in the store
  shared_store* store_;
  std::string key_;
  std::map<std::pair<moment, std::uint64_t>, verdict> known_;
};

}  // namespace pairsum::harness
