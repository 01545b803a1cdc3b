#include <pairsum/core/team.hpp>

#include <tbb/parallel_for.h>

#include <latch>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <pairsum/core/error.hpp>
#include <pairsum/core/omp_loop.hpp>
#include <pairsum/core/tbb_arena.hpp>

namespace pairsum {

void team::for_each(std::size_t n, index_function f) const {
  if (kind_ == runtime::tbb) {
    arena_->arena.execute([&] {
      ::tbb::parallel_for(
          std::size_t{0}, n, [&](std::size_t i) { f(i); }, ::tbb::simple_partitioner{});
    });
    return;
  }
  if (kind_ == runtime::omp && threads_ > 1) {
    omp_region(threads_, [&](int thread) {
      for (auto i = static_cast<std::size_t>(thread); i < n; i += static_cast<std::size_t>(threads_)) f(i);
    });
    return;
  }
  for (std::size_t i = 0; i < n; ++i) f(i);
}

void check_system(int threads) {
  static std::mutex one_at_a_time;
  static int given = 1;
  const std::lock_guard lock(one_at_a_time);
  if (threads <= given) return;
  std::latch end(1);
  std::vector<std::jthread> others;
  std::string why;
  try {
    while (static_cast<int>(others.size()) + 1 < threads) others.emplace_back([&end] { end.wait(); });
  } catch (const std::system_error& e) {
    why = e.what();
  }
  const std::size_t got = others.size() + 1;
  end.count_down();
  others.clear();
  if (!why.empty())
    throw error("the system gives " + std::to_string(got) + " of " + std::to_string(threads) + " threads (" + why +
                "); raise ulimit -u or the container's limit of processes, or take fewer threads");
  given = threads;
}

void check_team(int threads, int got) {
  if (got != threads)
    throw error("OpenMP gave " + std::to_string(got) + " of " + std::to_string(threads) +
                " threads; raise or unset OMP_THREAD_LIMIT, and unset OMP_DYNAMIC and OMP_MAX_ACTIVE_LEVELS");
}

void check_prepared(int threads, const team& t) {
  if (t.threads() > threads)
    throw error("prepared for " + std::to_string(threads) + " threads, but summed on " + std::to_string(t.threads()));
  const int arena = t.kind() == runtime::tbb ? t.arena().arena.max_concurrency() : t.threads();
  if (arena > t.threads())
    throw error("a team of " + std::to_string(t.threads()) + " oneTBB threads has an arena of " +
                std::to_string(arena) + ": make it with as many");
  if (t.kind() == runtime::tbb) check_arena(t.threads());
}

}  // namespace pairsum
