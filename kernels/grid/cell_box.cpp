#include "grid/cell_box.hpp"

#include <bit>
#include <limits>
#include <vector>

namespace pairsum {
namespace {

constexpr std::size_t chunk = 1024;  // of particles, whose flags stay in the first cache

/// The box of particles begin..end with coordinates of type Int.
template <class Int, int D, class R>
cell_box<D> box_of(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const box<D, R>& omega,
                   const cell_scale<D, R>& scale) {
  std::array<Int, D> low, high;
  low.fill(std::numeric_limits<Int>::max());
  high.fill(-1);
  std::array<Int, chunk> summed;
  for (; begin < end; begin += chunk) {
    const std::size_t n = std::min(chunk, end - begin);
    for (std::size_t k = 0; k < n; ++k) summed[k] = p.kind[begin + k] != particle_kind::lost;
    for (int d = 0; d < D; ++d) {
      const R* const x = p.x[d].data() + begin;
      for (std::size_t k = 0; k < n; ++k) summed[k] &= Int(x[k] >= omega.low[d]) & Int(x[k] <= omega.high[d]);
    }
    for (int d = 0; d < D; ++d) {
      const R* const x = p.x[d].data() + begin;
      Int a = low[d], b = high[d];
      for (std::size_t k = 0; k < n; ++k) {
        const Int c = scale.template cell<Int>(d, x[k]);
        a = std::min(a, summed[k] ? c : std::numeric_limits<Int>::max());
        b = std::max(b, summed[k] ? c : Int(-1));
      }
      low[d] = a, high[d] = b;
    }
  }
  cell_box<D> found;
  if (high[0] >= 0)
    for (int d = 0; d < D; ++d) found.low[d] = low[d], found.high[d] = high[d];
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
    parts[piece] =
        scale.with_integer([&](auto i) { return box_of<decltype(i)>(p, begin + b, begin + e, omega, scale); });
  });
  cell_box<D> all;
  for (const cell_box<D>& b : parts) all = all.with(b);
  return all;
}

template <int D, class R>
cell_box<D> box_follower<D, R>::fit(const particle_set<D, R>& p, std::size_t moved, const box<D, R>& omega,
                                    const cell_scale<D, R>& scale, const team& t) {
  if (moved != rest_begin_ || moved == p.size()) {
    rest_ = occupied_box(p, moved, p.size(), omega, scale, t);
    rest_begin_ = moved;
  }
  return rest_.with(occupied_box(p, 0, moved, omega, scale, t));
}

template <int D>
linear_cells<D>::linear_cells(const cell_box<D>& b) {
  for (int d = 0; d < D; ++d) {
    origin_[d] = b.low[d] - 1;
    stride_[d] = static_cast<std::uint32_t>(size_);
    size_ *= static_cast<std::size_t>(b.edge(d) + 2);
  }
}

template <int D>
double linear_cells<D>::numbers(const cell_box<D>& b) {
  double n = 1;
  for (int d = 0; d < D; ++d) n *= static_cast<double>(b.edge(d) + 2);
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
  scale.with_integer([&](auto integer) {
    using Int = decltype(integer);
    for (std::size_t first = begin; first < end; first += chunk) {
      const std::size_t n = std::min(chunk, end - first);
      std::uint32_t* const to = out.data() + (first - begin);
      for (int d = 0; d < D; ++d) {
        const R* const x = p.x[d].data() + first;
        const auto stride = stride_[d], origin = static_cast<std::uint32_t>(origin_[d]);  // modulo 2^32
        const auto part = [&](R a) {
          return (static_cast<std::uint32_t>(scale.template cell<Int>(d, a)) - origin) * stride;
        };
        if (d == 0)
          for (std::size_t k = 0; k < n; ++k) to[k] = part(x[k]);
        else
          for (std::size_t k = 0; k < n; ++k) to[k] += part(x[k]);
      }
    }
  });
}

template <int D>
std::uint8_t linear_cells<D>::parity(std::uint32_t number) const {
  std::uint8_t bits = 0;
  for (int d = D - 1; d >= 0; --d) {
    const std::int64_t c = origin_[d] + number / stride_[d];
    number %= stride_[d];
    bits = static_cast<std::uint8_t>(bits | (c & 1) << d);
  }
  return bits;
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
