#pragma once
#include <omp.h>

#include <cstddef>

#include "core/pass_observer.hpp"
#include "core/team.hpp"

namespace pairsum {

/// A worksharing loop inside an OpenMP parallel region, one of a pass: f(0) .. f(n-1), shared out as `g` says. All
/// threads of the region call it; those who are done go on without waiting for the others.
template <class Marks, class F>
void omp_share(unsigned pass, std::size_t n, const granularity& g, Marks& marks, F&& f) {
  // A function of its own, or each of the loops below would hold a copy of what it does.
  const auto unit = [&](std::size_t k) __attribute__((noinline)) {
    mark_unit(marks, pass, k);
    f(k);
  };
  const std::size_t chunk = g.chunk;
  if (g.how == schedule::guided) {
#pragma omp for schedule(guided, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else if (g.how == schedule::fixed && chunk == 0) {
#pragma omp for schedule(static) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else if (g.how == schedule::fixed) {
#pragma omp for schedule(static, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  } else {
#pragma omp for schedule(dynamic, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) unit(k);
  }
}

/// A pass inside an OpenMP parallel region, work() being each thread's part of it, with its marks. The threads leave it
/// together, when all are done.
template <class Marks, class Work>
void omp_pass_of(unsigned pass, Marks& marks, Work&& work) {
  const int thread = omp_get_thread_num();
  marks.work_begins(pass, thread);
  work();
  marks.work_ends(pass, thread);
#pragma omp barrier
  if (thread == 0) marks.pass_ends(pass);
}

/// A pass that is one loop.
template <class Marks, class F>
void omp_pass(unsigned pass, std::size_t n, const granularity& g, Marks& marks, F&& f) {
  omp_pass_of(pass, marks, [&] { omp_share(pass, n, g, marks, f); });
}

}  // namespace pairsum
