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
  /// Leaves out what is below `begin` in the first range.
  void begin_first_at(std::uint32_t begin) { ranges_[0].begin = begin; }
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
  /// the number. x_i is a point or its coordinates; near a face of a periodic box x_i - x_j may go through it.
  template <class Point, class Ranges, class Visit>
  [[gnu::always_inline]] static std::size_t each_in_reach(const positions<D, R>& x, const Point& x_i, R reach2,
                                                          const Ranges& ranges, Visit&& visit) {
    return batches_in_reach(
        x, x_i, reach2, ranges, [&](const std::uint32_t* hits, std::size_t n) __attribute__((always_inline)) {
          for (std::size_t k = 0; k < n; ++k) visit(hits[k]);
        });
  }

  /// The same, but calls visit(hits, n) for many at a time, and maybe for none.
  template <class Point, class Ranges, class Visit>
  [[gnu::always_inline]] static std::size_t batches_in_reach(const positions<D, R>& x, const Point& x_i, R reach2,
                                                             const Ranges& ranges, Visit&& visit) {
    // What visit does with a point that has this branch behind it needs no other for the faces.
    if (const auto* const across = across_of(x, x_i); across != nullptr) [[unlikely]]
      return each_through_faces(*across, x, x_i, reach2, ranges, visit);
    return each_inside(x, x_i, reach2, ranges, visit);
  }

  /// The same for candidates that were listed.
  template <class Point, class Visit>
  [[gnu::always_inline]] static std::size_t batches_in_reach(const positions<D, R>& x, const Point& x_i, R reach2,
                                                             const index_list& list, Visit&& visit) {
    if (const auto* const across = across_of(x, x_i); across != nullptr) [[unlikely]]
      return each_listed(x, point<D, R>{x_i, across}, reach2, list, visit);
    return each_listed(x, point<D, R>{x_i, nullptr}, reach2, list, visit);
  }

  static std::uint64_t size(const index_list& list) { return static_cast<std::uint64_t>(list.last - list.first); }
  template <class Ranges>
  static std::uint64_t size(const Ranges& ranges) {
    std::uint64_t n = 0;
    for (const index_range& range : ranges) n += range.end - range.begin;
    return n;
  }

 private:
  static constexpr std::uint32_t piece = 256;

  [[gnu::always_inline]] static const torus<D, R>* across_of(const positions<D, R>&, const point<D, R>& x_i) {
    return x_i.across;
  }
  [[gnu::always_inline]] static const torus<D, R>* across_of(const positions<D, R>& x, const vec<D, R>& x_i) {
    return x.omega.seen_from(x_i);
  }

  template <class Ranges, class Visit>
  [[gnu::always_inline]] static std::size_t each_inside(const positions<D, R>& x, const vec<D, R>& x_i, R reach2,
                                                        const Ranges& ranges, Visit&& visit) {
    std::uint32_t hits[2 * piece];
    std::size_t n = 0, total = 0;
    const auto flush = [&]() __attribute__((always_inline)) {
      visit(hits, n);
      total += n;
      n = 0;
    };
    for (const index_range& range : ranges) {
      for (std::uint32_t begin = range.begin; begin < range.end; begin += piece) {
        const std::uint32_t end = range.end - begin > piece ? begin + piece : range.end;
#pragma GCC unroll 4
        for (std::uint32_t j = begin; j < end; ++j) {
          hits[n] = j;
          n += norm2<D, R>(x_i - x[j]) < reach2;
        }
        if (n > piece) [[unlikely]]
          flush();
      }
    }
    flush();
    return total;
  }

  /// The same with ways through the faces; visit is compiled once here.
  template <class Ranges, class Visit>
  [[gnu::always_inline]] static std::size_t each_through_faces(const torus<D, R>& omega, const positions<D, R>& x,
                                                               const vec<D, R>& x_i, R reach2, const Ranges& ranges,
                                                               Visit&& visit) {
    std::uint32_t hits[2 * piece];
    std::size_t total = 0;
    auto range = ranges.begin();
    std::uint32_t j = range == ranges.end() ? 0 : range->begin;
    while (range != ranges.end()) {
      std::size_t n = 0;
      while (range != ranges.end() && n <= piece) {
        const std::uint32_t end = range->end - j > piece ? j + piece : range->end;
        for (; j < end; ++j) {
          hits[n] = j;
          vec<D, R> r = x_i - x[j];
          omega.shorten(r);
          n += norm2<D, R>(r) < reach2;
        }
        if (j >= range->end && ++range != ranges.end()) j = range->begin;
      }
      visit(hits, n);
      total += n;
    }
    return total;
  }

  template <class Visit>
  [[gnu::always_inline]] static std::size_t each_listed(const positions<D, R>& x, const point<D, R>& x_i, R reach2,
                                                        const index_list& list, Visit&& visit) {
    std::uint32_t hits[piece + 1];
    std::size_t total = 0;
    for (const std::uint32_t* begin = list.first; begin != list.last;) {
      const std::uint32_t* const end = list.last - begin > std::ptrdiff_t{piece} ? begin + piece : list.last;
      std::size_t n = 0;
      for (; begin != end; ++begin) {
        hits[n] = *begin;
        n += norm2<D, R>(x_i - x[*begin]) < reach2;
      }
      visit(hits, n);
      total += n;
    }
    return total;
  }
};

template <class I>
using filter_of = candidate_filter<I::dim, typename I::real>;

}  // namespace pairsum
