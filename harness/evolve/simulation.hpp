#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/evolve/time_step.hpp"
#include "harness/ranks/crew.hpp"

namespace pairsum::harness {

/// Particles at a time. Those that left Omega are not among them.
struct moment {
  particle_table particles;
  std::vector<std::uint32_t> ids;  ///< of each row, that of the start; ascending
  double t = 0;                    ///< s
  std::uint64_t step = 0;          ///< steps made
  double next_dt = 0;              ///< s, of the step that comes; 0: not known yet
  std::uint64_t lost = 0;          ///< particles that have left Omega
};

/// Particles before the first step, with their rows as ids.
moment start_of(const particle_table& p);

/// How a simulation steps.
struct step_rules {
  std::string integrator = "predictor_corrector";
  double dt = 0;     ///< s; 0: by the rule of time_step()
  double cfl = 0.2;  ///< of that rule
  bool drop = true;  ///< go on without particles that leave Omega; else they are an error
};

/// Steps particles with one backend. Two simulations from equal moments make equal bits if the backend does.
class simulation {
 public:
  /// @param domain Omega, gravity and constants; its particles do not matter
  /// @param ranks that hold the particles of `sum` together and call the same functions
  simulation(std::unique_ptr<summation> sum, const initial_condition& domain, moment start, const step_rules& rules,
             const team& t, const crew& ranks = alone());

  /// One step, shortened to end at `end` (s) exactly where it would go beyond. Throws pairsum::error that names the
  /// step and the particle for a state that is not finite, that flies apart (10 times the speed of sound), or that lost
  /// particles it may not lose.
  void step(double end);

  /// The state now, by id. Steps on from it itself, so that who goes on from this moment later makes the same bits.
  moment save();

  /// The state now, for a look: rows of particles that are lost are marked so.
  moment look() const;

  double last_dt() const { return last_dt_; }  ///< s, of the step made last; 0 before any
  double t() const { return now_.t; }
  std::uint64_t steps() const { return now_.step; }
  std::uint64_t lost() const { return now_.lost + sum_->lost(); }

 private:
  [[noreturn]] void fail(const std::string& what) const;

  /// Those of all ranks.
  extremes extremes_now();

  std::unique_ptr<summation> sum_;
  const initial_condition& domain_;
  moment now_;  ///< its particles are those that were loaded last
  step_rules rules_;
  const integrator_entry& integrator_;
  const team& team_;
  const crew& ranks_;
  double last_dt_ = 0;
};

}  // namespace pairsum::harness
