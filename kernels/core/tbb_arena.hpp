#pragma once
#include <tbb/task_arena.h>

#include <pairsum/core/team.hpp>

namespace pairsum {

/// Throws pairsum::error if a tbb::global_control lets oneTBB have fewer threads.
void check_arena(int threads);

/// While it lives, oneTBB may have so many threads, even if the machine has fewer cores. Several raise the limit to
/// what the largest says, where several tbb::global_control would lower it to the least.
class tbb_allowance {
 public:
  explicit tbb_allowance(int threads);
  ~tbb_allowance();
  tbb_allowance(const tbb_allowance&) = delete;
  tbb_allowance& operator=(const tbb_allowance&) = delete;

 private:
  int threads_;
};

/// The arena a team of oneTBB threads works in; made by the caller, who decides how many threads it has. Throws
/// pairsum::error where the program or the system gives fewer: see check_arena() and check_system().
struct tbb_arena {
  explicit tbb_arena(int threads) : limit(threads), arena(threads) {
    check_system(threads);
    check_arena(threads);
  }
  tbb_allowance limit;
  ::tbb::task_arena arena;
};

}  // namespace pairsum
