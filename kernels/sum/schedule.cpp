#include <pairsum/sum/schedule.hpp>

#include <pairsum/core/omp_loop.hpp>
#include <pairsum/core/tbb_loop.hpp>

namespace pairsum {

template <int D, class R>
void schedule<D, R>::sum(const problem_type& p, const team& t, const backend_traits& own, const pass_marks& marks) {
  const unsigned n = colours(p);
  if (n == 0) return;
  const granularity g = t.granularity_or(own.loop);
  switch (own.threads) {
    case runtime::serial:
      for (unsigned colour = 0; colour < n; ++colour)
        for (std::size_t k = 0, units = size(p, colour); k < units; ++k) {
          marks.unit_begins(colour, k);
          unit(p, colour, k, 0);
        }
      break;
    case runtime::omp:
      marks.pass_begins(0);
      omp_region(t.threads(), [&](int thread) {
        for (unsigned colour = 0; colour < n; ++colour)
          omp_pass(colour, size(p, colour), g, marks, thread, [&](std::size_t k) { unit(p, colour, k, thread); });
      });
      break;
    case runtime::tbb:
      t.arena().arena.execute([&] {
        for (unsigned colour = 0; colour < n; ++colour)
          tbb_pass(colour, size(p, colour), g, marks, [&](std::size_t k, int thread) { unit(p, colour, k, thread); });
      });
  }
}

#define PAIRSUM_SCHEDULES(D, R) template class schedule<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_SCHEDULES)

}  // namespace pairsum
