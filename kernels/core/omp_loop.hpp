#pragma once
#include <omp.h>

#include <algorithm>
#include <cstddef>

#include <pairsum/core/pass_observer.hpp>
#include <pairsum/core/team.hpp>

namespace pairsum {

/// f(thread) on every thread of an OpenMP team. Throws pairsum::error, before any work, if the team came out smaller.
template <class F>
void omp_region(int threads, F&& f) {
  int got = threads;
#pragma omp parallel num_threads(threads)
  {
    if (omp_get_num_threads() == threads) [[likely]]
      f(omp_get_thread_num());
    else if (omp_get_thread_num() == 0)
      got = omp_get_num_threads();
  }
  check_team(threads, got);
}

/// A pass inside an OpenMP region, with its marks: f(0) .. f(n-1), distributed as `g` says. All threads of the region
/// call it, and leave it together, when all are done.
template <class F>
void omp_pass(unsigned pass, std::size_t n, const granularity& g, const pass_marks& marks, int thread, F&& f) {
  // A separate function, or each of the loops below would hold a copy of it.
  const auto unit = [&](std::size_t k) __attribute__((noinline)) {
    marks.unit_begins(pass, k);
    f(k);
  };
  marks.work_begins(pass, thread);
  const std::size_t chunk = std::max<std::size_t>(g.chunk, 1);
  if (g.how == loop_schedule::guided) {  // NOLINT(bugprone-branch-clone): what differs is how it is shared out
#pragma omp for schedule(guided, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else if (g.how == loop_schedule::fixed && g.chunk == 0) {
#pragma omp for schedule(static) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else if (g.how == loop_schedule::fixed) {
#pragma omp for schedule(static, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else {
#pragma omp for schedule(dynamic, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  }
  marks.work_ends(pass, thread);
#pragma omp barrier
  if (thread == 0) marks.pass_ends(pass);
}

}  // namespace pairsum
