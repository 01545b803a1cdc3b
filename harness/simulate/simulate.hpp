#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "harness/evolve/balance.hpp"
#include "harness/evolve/simulation.hpp"
#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// What `pairsum simulate` does.
struct simulate_request {
  run_request levels;  ///< one of each
  step_rules rules;
  double until = 0.5;               ///< s
  double every = 0;                 ///< s between snapshots; 0: as before in the folder, else until / 20
  double checkpoint = 0;            ///< s between checkpoints besides the snapshots; 0: as before, else none
  double log = 0;                   ///< s between rows of the log; 0: until / 200
  std::filesystem::path snapshots;  ///< folder of snapshots, log and checkpoint; empty: nothing is kept
  bool fresh = false;               ///< start over where the folder holds a simulation
  std::string binding = "cores_first";
};

/// What a simulation came to.
struct simulate_result {
  point what;  ///< words of the backend and its formula
  moment end;
  double resumed_from = 0;  ///< s; 0: from the start
  double seconds = 0;       ///< of this process, steps alone
  std::uint64_t steps = 0;  ///< of this process
  bool interrupted = false;
};

/// Called with the state, its balance and the energy at t = 0 (J), at the start, at every snapshot and at the end.
using moment_reader = std::function<void(const moment&, const balance&, double)>;

/// Throws pairsum::error for a request that makes no sense, a folder of another simulation, and states that are not
/// finite, fly apart or lose what they may not. SIGINT and SIGTERM end it after the step under way; then it goes on
/// from the last checkpoint when it is called again.
simulate_result simulate(const simulate_request& r, const moment_reader& at);

}  // namespace pairsum::harness
