#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include <pairsum/cases/case.hpp>
#include <pairsum/sum/costs.hpp>
#include "harness/evolve/initial_of.hpp"
#include "harness/measure/binding.hpp"
#include "harness/measure/counters.hpp"
#include "harness/plan/plan.hpp"
#include "harness/ranks/placement.hpp"
#include "harness/verify/verifier.hpp"

namespace pairsum::harness {

/// One timed (or warming) step of a point.
struct step_result {
  phases times;
  std::optional<thread_times> threads_busy_s, barrier_wait_s;
  std::optional<counters_row> counted;
  std::uint64_t lost = 0;                       ///< particles found outside Omega
  std::optional<std::uint64_t> threads_worked;  ///< see threads_worked()
  std::optional<std::vector<rank_row>> ranks;   ///< of a point with several
  verifier::outcome checked;
};

/// The particles of a (dx, state), made once for all worlds that have them, and their orders of memory by name.
struct world_particles {
  particles_of_request made;
  const initial_condition& initial = made.initial;
  std::map<std::string, std::vector<std::uint32_t>> orders;
  std::size_t dropped = 0;  ///< lay outside Omega and were left out (--outside drop)

  world_particles(const run_request& r, const point& any);
  world_particles(const world_particles&) = delete;
  world_particles& operator=(const world_particles&) = delete;
};

/// What measurements of a process have in common.
struct measuring {
  const registry& all;
  const thread_binding& binding;
  counters& hardware;
  shared_store* store = nullptr;  ///< of references and verdicts, from and for other processes
  std::string build;              ///< tells the store's entries of different programs apart
  std::uint64_t last_level_cache_bytes = 0;
  std::vector<rank_seat> seats;  ///< of all ranks
};

/// The particles of one world and their reference, and the measurement of any backend on them.
class world {
 public:
  /// Checks the particles. With several ranks all of them make it, and call the same functions. `any` is one of the
  /// world's points.
  world(const measuring& with, const run_request& r, const point& any,
        std::shared_ptr<const world_particles> particles);

  /// Makes the reference or finds it in the store; to be called before the first measure().
  void make_reference();
  /// Hands reference, verdicts and work to the processes that come later.
  void remember();

  /// Fills in what depends on the case: H and particle numbers.
  void complete(point& p) const;

  struct result {
    std::vector<step_result> steps;
    std::optional<work_row> work;  ///< of the initial state
    std::optional<std::uint64_t> peak_rss_bytes;
    std::optional<std::uint64_t> workspace_bytes;  ///< by which the first prepare, zero, sum and reduce grew the heap
    bool interrupted = false;                      ///< the steps after an interrupt were not made
    std::string error;                             ///< set if a step was wrong; steps after it were not made
    bool bad_state = false;                        ///< the error is of the state, not of the sum
    std::string untimed;                           ///< why its times are no times; empty if they are
  };

  /// Loads the initial state and makes the steps. Each step's rates are verified before its times are handed out; a
  /// step's verification is not part of its times.
  /// @param steps how many; 0: as many as the request says
  result measure(const point& p, int steps = 0);

  std::size_t dropped() const { return particles_->dropped; }
  const particles_of_request& particles() const { return particles_->made; }

 private:
  work_row work_of(const point& p, summation& s);

  std::string key() const;
  void recall_work();

  measuring with_;
  run_request request_;
  point any_;
  std::shared_ptr<const world_particles> particles_;
  std::unique_ptr<verifier> verifier_;
  std::map<std::string, work_row> work_;  ///< by backend, grid, M and block
  std::optional<unfolded_tests> unfolded_;
  std::optional<formula_costs> costs_;
};

}  // namespace pairsum::harness
