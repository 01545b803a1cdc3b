#pragma once
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <thread>

namespace pairsum {

/// The arena a team of oneTBB threads works in; made by the caller, who decides how many threads it has. While it
/// lives, oneTBB may have as many threads, even if the machine has fewer cores.
struct tbb_arena {
  explicit tbb_arena(int threads)
      : limit(::tbb::global_control::max_allowed_parallelism,
              std::max(static_cast<std::size_t>(threads), std::size_t{std::thread::hardware_concurrency()})),
        arena(threads) {}
  ::tbb::global_control limit;
  ::tbb::task_arena arena;
};

}  // namespace pairsum
