#pragma once
#include <omp.h>

#include <cstddef>

#include "core/pass_observer.hpp"
#include "core/team.hpp"

namespace pairsum {

/// The worksharing loop of one pass inside an OpenMP parallel region: f(0) .. f(n-1), shared out as `g` says, with the
/// marks of the pass. All threads of the region call it; they leave it together, when the pass is done.
template <class F>
void omp_pass(unsigned pass, std::size_t n, const granularity& g, const pass_marks& marks, F&& f) {
  const int thread = omp_get_thread_num();
  marks.work_begins(pass, thread);
  const std::size_t chunk = g.chunk;
  if (g.how == schedule::guided) {
#pragma omp for schedule(guided, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) f(k);
  } else if (g.how == schedule::fixed && chunk == 0) {
#pragma omp for schedule(static) nowait
    for (std::size_t k = 0; k < n; ++k) f(k);
  } else if (g.how == schedule::fixed) {
#pragma omp for schedule(static, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) f(k);
  } else {
#pragma omp for schedule(dynamic, chunk) nowait
    for (std::size_t k = 0; k < n; ++k) f(k);
  }
  marks.work_ends(pass, thread);
#pragma omp barrier
  if (thread == 0) marks.pass_ends(pass);
}

}  // namespace pairsum
