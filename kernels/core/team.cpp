#include "core/team.hpp"

#include <tbb/parallel_for.h>

#include <string>

#include "core/error.hpp"
#include "core/tbb_arena.hpp"

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
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
    for (std::size_t i = 0; i < n; ++i) f(i);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) f(i);
}

void check_prepared(int threads, const team& t) {
  if (t.threads() > threads)
    throw error("prepared for " + std::to_string(threads) + " threads, but to be summed on " +
                std::to_string(t.threads()));
}

}  // namespace pairsum
