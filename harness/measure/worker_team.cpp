#include "harness/measure/worker_team.hpp"

#include <omp.h>

#include "core/tbb_arena.hpp"

namespace pairsum::harness {

worker_team::worker_team(runtime kind, int threads) {
  if (kind == runtime::omp) {
    team_ = team::omp(threads);
    return;
  }
  omp_pause_resource_all(omp_pause_hard);
  if (kind == runtime::tbb) {
    arena_ = std::make_unique<tbb_arena>(threads);
    team_ = team::tbb(threads, *arena_);
  }
}

worker_team::~worker_team() = default;

}  // namespace pairsum::harness
