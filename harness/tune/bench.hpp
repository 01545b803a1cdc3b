#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/measure/binding.hpp"
#include "harness/run/world.hpp"
#include "harness/tune/tune.hpp"

namespace pairsum::harness {

/// Measures candidates on the particles of one case, in this process.
class tune_bench {
 public:
  tune_bench(const tune_request& r, const point& any, const registry& all);

  /// Of M that nobody asked for those that do not go round a periodic box. Throws pairsum::error if nothing is left.
  void leave_out_M_that_do_not_fit(std::vector<point>& points) const;

  /// Of backends that nobody named those whose skin a periodic box has no room for.
  void leave_out_wide_skins(std::vector<point>& points) const;

  /// Throws pairsum::error if a point's summation does not take the particles.
  void check_input(const point& p) const;

  void complete(point& p) const;

  /// Seconds of one evaluation, as far as the request's phase counts; empty, with `error` set, if its rates were wrong.
  std::optional<double> measure(const point& p, std::string& error);

  /// Makes the references that the points need.
  void make_reference(const point& p);

 private:
  /// Evaluates once; seconds, or empty with `error` set.
  std::optional<double> evaluate(summation& s, const point& p, const team& t, std::string& error);

  const tune_request& request_;
  const registry& all_;
  thread_binding binding_;
  world_particles particles_;
  std::map<std::string, std::unique_ptr<verifier>> verifiers_;  ///< by precision
};

}  // namespace pairsum::harness
