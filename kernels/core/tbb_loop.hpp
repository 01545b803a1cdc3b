#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "core/pass_observer.hpp"
#include "core/tbb_arena.hpp"
#include "core/team.hpp"

namespace pairsum {

/// One pass on the threads of the arena that the caller is in: f(begin) .. f(end-1), shared out as `g` says, with the
/// marks of the pass; returns when the pass is done.
template <class Marks, class F>
void tbb_pass(unsigned pass, std::size_t begin, std::size_t end, const granularity& g, Marks& marks, F&& f) {
  using range = ::tbb::blocked_range<std::size_t>;
  const range all(begin, end, g.chunk);
  const auto piece = [&](const range& r) __attribute__((noinline)) {  // for the reason told in omp_loop.hpp
    const int thread = ::tbb::this_task_arena::current_thread_index();
    marks.work_begins(pass, thread);
    for (std::size_t k = r.begin(); k < r.end(); ++k) {
      mark_unit(marks, pass, k);
      f(k);
    }
    marks.work_ends(pass, thread);
  };
  marks.pass_begins(pass);
  switch (g.how) {
    case schedule::simple:
      ::tbb::parallel_for(all, piece, ::tbb::simple_partitioner{});
      break;
    case schedule::fixed:
      ::tbb::parallel_for(all, piece, ::tbb::static_partitioner{});
      break;
    default:
      ::tbb::parallel_for(all, piece, ::tbb::auto_partitioner{});
  }
  marks.pass_ends(pass);
}

}  // namespace pairsum
