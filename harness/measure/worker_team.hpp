#pragma once
#include <memory>

#include "core/team.hpp"

namespace pairsum {
struct tbb_arena;
}

namespace pairsum::harness {

/// The threads of one measurement: a number for OpenMP, an arena for oneTBB, the caller for serial backends. Before
/// anything but OpenMP runs, OpenMP's workers are sent away: waiting they would spin on the cores of the others.
class worker_team {
 public:
  worker_team(runtime kind, int threads);
  ~worker_team();
  const team& get() const { return team_; }

 private:
  std::unique_ptr<tbb_arena> arena_;
  team team_;
};

}  // namespace pairsum::harness
