#include <pairsum/grid/cell_box.hpp>

#include <bit>
#include <limits>
#include <vector>

namespace pairsum {
namespace {

constexpr std::size_t chunk = 1024;  // of particles, whose flags stay in the first cache

/// Smallest and largest of n numbers, none of them NaN; or low > high if one is.
template <class R>
std::array<R, 2> extent(const R* x, std::size_t n) {
  R low = std::numeric_limits<R>::infinity(), high = -low;
  unsigned numbers = 1;
#pragma omp simd reduction(min : low) reduction(max : high) reduction(& : numbers)
  for (std::size_t k = 0; k < n; ++k) {
    low = x[k] < low ? x[k] : low;
    high = x[k] > high ? x[k] : high;
    numbers &= unsigned(x[k] == x[k]);
  }
  return numbers ? std::array{low, high} : std::array{R(1), R(-1)};
}

/// The box of particles begin..end. Cell coordinates ascend with positions, so of a chunk that is all inside Omega its
/// extent says enough.
template <int D, class R>
cell_box<D> box_of(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const box<D, R>& omega,
                   const cell_scale<D, R>& scale) {
  cell_box<D> found;
  const auto take = [&](const vec<D, R>& low, const vec<D, R>& high) {
    cell_box<D> b;
    for (int d = 0; d < D; ++d) {
      b.low[d] = scale.template cell<std::int64_t>(d, low[d]);
      b.high[d] = scale.template cell<std::int64_t>(d, high[d]);
    }
    found = found.with(b);
  };
  for (; begin < end; begin += chunk) {
    const std::size_t stop = std::min(begin + chunk, end);
    const auto is_lost = [](particle_kind k) { return k == particle_kind::lost; };
    bool all = std::none_of(p.kind.data() + begin, p.kind.data() + stop, is_lost);
    vec<D, R> low, high;
    for (int d = 0; d < D && all; ++d) {
      const auto [a, b] = extent(p.x[d].data() + begin, stop - begin);
      all = a >= omega.low[d] && b <= omega.high[d] && a <= b;
      low[d] = a, high[d] = b;
    }
    if (all) take(low, high);
    for (std::size_t i = begin; i < stop && !all; ++i)
      if (!is_lost(p.kind[i]) && omega.contains(p.position(i))) take(p.position(i), p.position(i));
  }
  return found;
}

}  // namespace

template <int D>
double cell_box<D>::cells() const {
  double n = 1;
  for (int d = 0; d < D; ++d) n *= static_cast<double>(edge(d));
  return n;
}

template <int D>
std::string cell_box<D>::text() const {
  std::string all;
  for (int d = 0; d < D; ++d) all += (d > 0 ? " x " : "") + std::to_string(edge(d));
  return all;
}

template <int D>
cell_box<D> cell_box<D>::with(const cell_box& o) const {
  if (empty()) return o;
  if (o.empty()) return *this;
  cell_box both;
  for (int d = 0; d < D; ++d) {
    both.low[d] = std::min(low[d], o.low[d]);
    both.high[d] = std::max(high[d], o.high[d]);
  }
  return both;
}

template <int D, class R>
cell_box<D> occupied_box(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const box<D, R>& omega,
                         const cell_scale<D, R>& scale, const team& t) {
  std::vector<cell_box<D>> parts(static_cast<std::size_t>(t.threads()));
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    parts[piece] = box_of(p, begin + b, begin + e, omega, scale);
  });
  cell_box<D> all;
  for (const cell_box<D>& b : parts) all = all.with(b);
  return all;
}

template <int D, class R>
cell_box<D> box_follower<D, R>::fit(const particle_set<D, R>& p, std::size_t moved, const box<D, R>& omega,
                                    const cell_scale<D, R>& scale, const team& t) {
  const auto with_periodic_axes = [&](cell_box<D> b) {
    for (int d = 0; d < D; ++d)
      if (scale.period[d] > 0) b.low[d] = 0, b.high[d] = scale.period[d] - 1;
    return b;
  };
  if (std::ranges::count(scale.period, 0) == 0) return with_periodic_axes({});
  if (moved != rest_begin_ || moved == p.size()) {
    rest_ = occupied_box(p, moved, p.size(), omega, scale, t);
    rest_begin_ = moved;
  }
  return with_periodic_axes(rest_.with(occupied_box(p, 0, moved, omega, scale, t)));
}

template <int D>
linear_cells<D>::linear_cells(const cell_box<D>& b, const ivec<D>& period) {
  for (int d = 0; d < D; ++d) {
    const std::int64_t around = period[d] > 0 ? 0 : 1;
    origin_[d] = b.low[d] - around;
    stride_[d] = static_cast<std::uint32_t>(size_);
    size_ *= static_cast<std::size_t>(b.edge(d) + 2 * around);
  }
}

template <int D>
double linear_cells<D>::numbers(const cell_box<D>& b, const ivec<D>& period) {
  double n = 1;
  for (int d = 0; d < D; ++d) n *= static_cast<double>(b.edge(d) + (period[d] > 0 ? 0 : 2));
  return n;
}

template <int D>
int linear_cells<D>::bits() const {
  return std::bit_width(size_ - 1);
}

template <int D>
template <class R>
void linear_cells<D>::numbers_of(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                                 const cell_scale<D, R>& scale, std::span<std::uint32_t> out) const {
  scale.with_integer([&, to = out.data(), stride = stride_, scale = scale](auto integer) {
    std::array<const R*, D> x;
    for (int d = 0; d < D; ++d) x[d] = p.x[d].data();
    std::uint32_t first = 0;  // number of cell (0, 0, 0), all modulo 2^32
    for (int d = 0; d < D; ++d) first -= static_cast<std::uint32_t>(origin_[d]) * stride_[d];
    for (std::size_t i = begin; i < end; ++i) {
      std::uint32_t number = first;
      for (int d = 0; d < D; ++d)
        number += static_cast<std::uint32_t>(scale.template cell<decltype(integer)>(d, x[d][i])) * stride[d];
      to[i - begin] = number;
    }
  });
}

template <int D>
ivec<D> linear_cells<D>::place(std::uint32_t number) const {
  ivec<D> at;
  for (int d = D - 1; d >= 0; --d) {
    at[d] = origin_[d] + number / stride_[d];
    number %= stride_[d];
  }
  return at;
}

#define PAIRSUM_CELL_BOX(D, R)                                                                      \
  template class box_follower<D, R>;                                                                \
  template void linear_cells<D>::numbers_of<R>(const particle_set<D, R>&, std::size_t, std::size_t, \
                                               const cell_scale<D, R>&, std::span<std::uint32_t>) const;
#define PAIRSUM_CELL_BOXES(D)     \
  template struct cell_box<D>;    \
  template class linear_cells<D>; \
  PAIRSUM_CELL_BOX(D, double)     \
  PAIRSUM_CELL_BOX(D, float)
PAIRSUM_CELL_BOXES(1)
PAIRSUM_CELL_BOXES(2)
PAIRSUM_CELL_BOXES(3)
#undef PAIRSUM_CELL_BOXES
#undef PAIRSUM_CELL_BOX

}  // namespace pairsum
