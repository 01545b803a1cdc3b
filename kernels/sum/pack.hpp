#pragma once
#include <pairsum/core/error.hpp>
#include <pairsum/sum/problem.hpp>

/// What listers share.
namespace pairsum {

/// Partners and rows that a thread has room for on its stack.
inline constexpr std::size_t most_hits = 6144, most_rows = 64;

/// The candidates of a range, or a list, within the cutoff of x_i, appended to `to`. `at` maps number j to a candidate.
template <int D, class R, class At>
[[gnu::always_inline]] inline std::uint32_t* pack_of(const positions<D, R>& x, const point<D, R>& x_i, R reach2,
                                                     std::uint32_t begin, std::uint32_t end, std::uint32_t* to, At at) {
  if (x_i.across != nullptr) [[unlikely]] {
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t j = at(k);
      vec<D, R> r = x_i.x - x[j];
      x_i.across->to_minimum_image(r);
      *to = j;
      to += norm2<D, R>(r) < reach2;
    }
    return to;
  }
#pragma GCC unroll 4
  for (std::uint32_t k = begin; k < end; ++k) {
    const std::uint32_t j = at(k);
    *to = j;
    to += norm2<D, R>(x_i.x - x[j]) < reach2;
  }
  return to;
}

/// The function that updates both sides. Vector units have none that adds atomically; a schedule that adds atomically
/// states so in its traits and runs as scalar code.
template <int D, class R>
rows_function both_sides(const problem<D, R>& p, update how) {
  const rows_function take = p.pairs->both[static_cast<unsigned>(how)];
  if (take == nullptr) [[unlikely]]
    throw error("a schedule that adds atomically needs the trait .conflicts = conflict_avoidance::atomics");
  return take;
}

/// Takes the work of rows besides having them summed.
struct counted_rows {
  const row_sink& inner;
  work_counts& counts;
  static void take(const void* call, const row* rows, std::size_t n) {
    const auto& self = *static_cast<const counted_rows*>(call);
    for (std::size_t k = 0; k < n; ++k) self.counts.evaluated(rows[k].fluid_count, rows[k].boundary_count);
    self.inner.take(self.inner.call, rows, n);
  }
};

}  // namespace pairsum
