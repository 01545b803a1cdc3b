#pragma once
#include <omp.h>

#include <cstddef>

#include "core/pass_observer.hpp"
#include "core/team.hpp"

namespace pairsum {

/// The worksharing loop of one pass inside an OpenMP parallel region: f(0) .. f(n-1), shared out as `g` says, with the
/// marks of the pass. All threads of the region call it; those who are done go on without waiting for the others.
template <class Marks, class F>
void omp_pass_without_barrier(unsigned pass, std::size_t n, const granularity& g, Marks& marks, F&& f) {
  const int thread = omp_get_thread_num();
  const auto unit = [&](std::size_t k) {
    mark_unit(marks, pass, k);
    f(k);
  };
  marks.work_begins(pass, thread);
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
  marks.work_ends(pass, thread);
}

/// The same; the threads leave it together, when the pass is done.
template <class Marks, class F>
void omp_pass(unsigned pass, std::size_t n, const granularity& g, Marks& marks, F&& f) {
  omp_pass_without_barrier(pass, n, g, marks, f);
#pragma omp barrier
  if (omp_get_thread_num() == 0) marks.pass_ends(pass);
}

}  // namespace pairsum
