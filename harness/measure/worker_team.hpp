#pragma once
#include <chrono>
#include <memory>

#include <pairsum/core/team.hpp>

namespace pairsum {
struct tbb_arena;
}

namespace pairsum::harness {

class thread_binding;

/// The threads of one measurement: a number for OpenMP, an arena for oneTBB, the caller for serial backends. Before
/// anything but OpenMP runs, OpenMP's workers are released: waiting they would spin on the cores of the others.
///
/// With a binding, which must outlive the team, thread k runs on the binding's unit k: OpenMP's thread k, the thread in
/// slot k of oneTBB's arena, the caller as thread 0. When the team ends, caller and OpenMP threads are unbound;
/// oneTBB's are unbound when they have left the arena. One bound team lives at a time.
///
/// A team that does not come out with all its threads is a pairsum::error.
class worker_team {
 public:
  /// @param first thread k runs on unit first + k
  worker_team(runtime kind, int threads, const thread_binding* binding = nullptr, int first = 0);
  ~worker_team();
  const team& get() const { return team_; }

 private:
  class slot_binder;
  const thread_binding* binding_;
  std::unique_ptr<tbb_arena> arena_;
  std::unique_ptr<slot_binder> binder_;  ///< goes before the arena
  team team_;
};

/// Threads for work that is not timed: of so many cores those that OMP_THREAD_LIMIT leaves.
int untimed_threads(int cores);

/// How many of the team's threads work at the same time, if they get `patience` to come.
int threads_at_once(const team& t, std::chrono::milliseconds patience);

}  // namespace pairsum::harness
