#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include <pairsum/core/pass_observer.hpp>
#include <pairsum/core/tbb_arena.hpp>
#include <pairsum/core/team.hpp>

namespace pairsum {

/// One pass on the threads of the arena that the caller is in: f(0, thread) .. f(n-1, thread), shared out as `g` says,
/// with the marks of the pass; returns when the pass is done.
template <class F>
void tbb_pass(unsigned pass, std::size_t n, const granularity& g, const pass_marks& marks, F&& f) {
  using range = ::tbb::blocked_range<std::size_t>;
  const range all(0, n, std::max<std::size_t>(g.chunk, 1));
  const auto piece = [&](const range& r) __attribute__((noinline)) {  // for the reason given in omp_loop.hpp
    const int thread = ::tbb::this_task_arena::current_thread_index();
    marks.work_begins(pass, thread);
    for (std::size_t k = r.begin(); k < r.end(); ++k) {
      marks.unit_begins(pass, k);
      f(k, thread);
    }
    marks.work_ends(pass, thread);
  };
  marks.pass_begins(pass);
  switch (g.how) {
    case loop_schedule::simple:
      ::tbb::parallel_for(all, piece, ::tbb::simple_partitioner{});
      break;
    case loop_schedule::fixed:
      ::tbb::parallel_for(all, piece, ::tbb::static_partitioner{});
      break;
    default:
      ::tbb::parallel_for(all, piece, ::tbb::auto_partitioner{});
  }
  marks.pass_ends(pass);
}

}  // namespace pairsum
