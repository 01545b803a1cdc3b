#include <pairsum/core/workers.hpp>

#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/tbb_arena.hpp>

namespace pairsum {

workers::workers(runtime kind, int threads) : team_(team::omp(threads)) {
  if (threads < 1) throw error("a team needs at least 1 thread, got " + std::to_string(threads));
  if (kind != runtime::tbb) return;
  arena_ = std::make_unique<tbb_arena>(threads);
  team_ = team::tbb(threads, *arena_);
}

workers::~workers() = default;

}  // namespace pairsum
