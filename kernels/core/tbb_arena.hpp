#pragma once
#include <tbb/task_arena.h>

namespace pairsum {

/// The arena a team of oneTBB threads works in; made by the caller, who decides how many threads it has.
struct tbb_arena {
  explicit tbb_arena(int threads) : arena(threads) {}
  ::tbb::task_arena arena;
};

}  // namespace pairsum
