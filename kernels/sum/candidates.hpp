#pragma once
#include <array>

#include "sum/problem.hpp"

namespace pairsum {

/// A contiguous range of particle indices.
struct index_range {
  std::uint32_t begin, end;
};

/// Up to `Capacity` ranges on the stack; ranges that touch are merged, so that cells in a row become one long range.
template <unsigned Capacity>
class range_list {
 public:
  void add(std::uint32_t begin, std::uint32_t end) {
    if (begin == end) return;
    if (n_ > 0 && ranges_[n_ - 1].end == begin)
      ranges_[n_ - 1].end = end;
    else
      ranges_[n_++] = {begin, end};
  }
  const index_range* begin() const { return ranges_.data(); }
  const index_range* end() const { return ranges_.data() + n_; }
  bool empty() const { return n_ == 0; }

 private:
  std::array<index_range, Capacity> ranges_;
  unsigned n_ = 0;
};

/// Candidates that were listed one by one.
struct index_list {
  const std::uint32_t *first, *last;
  const std::uint32_t* begin() const { return first; }
  const std::uint32_t* end() const { return last; }
  bool empty() const { return first == last; }
};

/// Finds the candidates of one particle that are in reach. Two steps instead of one loop: the first only tests
/// distances and packs the indices that pass without a branch, the second (the visitor) runs the formula on those
/// alone; so the branch predictor never has to guess a distance.
template <int D, class R>
class candidate_filter {
 public:
  /// Calls visit(j) for every j of the ranges with |x_i - x_j|^2 < reach2, in ascending order within a range; returns
  /// the number. Near a face of a periodic box x_i - x_j may go through it.
  template <class Ranges, class Visit>
  [[gnu::always_inline]] static std::size_t each_in_reach(const positions<D, R>& x, const vec<D, R>& x_i, R reach2,
                                                          const Ranges& ranges, Visit&& visit) {
    constexpr std::uint32_t piece = 256;
    std::uint32_t hits[2 * piece];
    std::size_t n = 0, total = 0;
    const torus<D, R>* const across = x.omega.seen_from(x_i);
    const auto flush = [&]() __attribute__((always_inline)) {
      for (std::size_t k = 0; k < n; ++k) visit(hits[k]);
      total += n;
      n = 0;
    };
    for (const index_range& range : ranges) {
      for (std::uint32_t begin = range.begin; begin < range.end; begin += piece) {
        const std::uint32_t end = range.end - begin > piece ? begin + piece : range.end;
        if (across == nullptr) [[likely]] {
#pragma GCC unroll 4
          for (std::uint32_t j = begin; j < end; ++j) {
            hits[n] = j;
            n += norm2<D, R>(x_i - x[j]) < reach2;
          }
        } else {
          for (std::uint32_t j = begin; j < end; ++j) {
            hits[n] = j;
            n += norm2<D, R>(across->shortest(x_i - x[j])) < reach2;
          }
        }
        if (n > piece) [[unlikely]]
          flush();
      }
    }
    flush();
    return total;
  }

  template <class Visit>
  [[gnu::always_inline]] static std::size_t each_in_reach(const positions<D, R>& x, const vec<D, R>& x_i, R reach2,
                                                          const index_list& list, Visit&& visit) {
    constexpr std::ptrdiff_t piece = 256;
    std::uint32_t hits[piece + 1];
    std::size_t total = 0;
    const point<D, R> from{x_i, x.omega.seen_from(x_i)};
    for (const std::uint32_t* begin = list.first; begin != list.last;) {
      const std::uint32_t* const end = list.last - begin > piece ? begin + piece : list.last;
      std::size_t n = 0;
      for (; begin != end; ++begin) {
        hits[n] = *begin;
        n += norm2<D, R>(from - x[*begin]) < reach2;
      }
      for (std::size_t k = 0; k < n; ++k) visit(hits[k]);
      total += n;
    }
    return total;
  }

  static std::uint64_t size(const index_list& list) { return static_cast<std::uint64_t>(list.last - list.first); }
  template <class Ranges>
  static std::uint64_t size(const Ranges& ranges) {
    std::uint64_t n = 0;
    for (const index_range& range : ranges) n += range.end - range.begin;
    return n;
  }
};

template <class I>
using filter_of = candidate_filter<I::dim, typename I::real>;

}  // namespace pairsum
