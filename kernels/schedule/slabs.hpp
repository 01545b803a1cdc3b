#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <pairsum/schedule/layers.hpp>

namespace pairsum {

/// Cells [begin, end) that are swept while the locks `low` and `high` are held, low first; -1: no lock.
struct stretch {
  std::uint32_t begin = 0, end = 0;
  std::int32_t low = -1, high = -1;
};

/// Layers that one thread sweeps: the first, those between, the last. Lock k is for the first layer of slab k, the only
/// one of its layers that another slab writes to, namely the one before when it sweeps its last layer.
using slab = std::array<stretch, 3>;

/// Where to cut work into at most `most` contiguous pieces, so that the largest is as small as can be. Returns the
/// beginnings of the pieces, of which none is empty, and the end.
inline std::vector<std::size_t> cut_evenly(std::span<const std::uint64_t> work, std::size_t most) {
  std::vector<std::uint64_t> before(work.size() + 1, 0);
  for (std::size_t k = 0; k < work.size(); ++k) before[k + 1] = before[k] + std::max<std::uint64_t>(work[k], 1);
  std::vector<std::size_t> cuts;
  const auto fits = [&](std::uint64_t capacity) {
    cuts.assign(1, 0);
    while (cuts.back() < work.size() && cuts.size() <= most) {
      const auto end = std::upper_bound(before.begin(), before.end(), before[cuts.back()] + capacity) - 1;
      if (static_cast<std::size_t>(end - before.begin()) == cuts.back()) return false;  // one alone is too much
      cuts.push_back(static_cast<std::size_t>(end - before.begin()));
    }
    return cuts.back() == work.size();
  };
  std::uint64_t low = before.back() / std::max<std::size_t>(most, 1), high = before.back();
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (fits(middle))
      high = middle;
    else
      low = middle + 1;
  }
  fits(high);
  return cuts;
}

/// Slabs of the listed layers, at most `most`, as nearly equal in work as whole layers allow. `around`: see
/// layers_around(). No lock is taken where there is a gap between two slabs, and none for one slab. A slab of one layer
/// holds both of its locks at once; as all are taken in ascending order, no ring of slabs waits for each other.
inline std::vector<slab> cut_slabs(std::span<const cell_layer> layers, std::span<const std::uint64_t> work,
                                   std::int64_t around, std::size_t most) {
  const std::vector<std::size_t> cuts = cut_evenly(work, most);
  const std::size_t n = cuts.size() - 1;
  std::vector<slab> slabs(n);
  const auto lock_of = [&](std::size_t k) {  // where slab k begins, if the slab before writes to its first layer
    const std::size_t last = cuts[k == 0 ? n : k] - 1;
    const bool met = n > 1 && layer_after(layers[last].at, around) == layers[cuts[k]].at;
    return met ? static_cast<std::int32_t>(k) : -1;
  };
  const auto cells = [&](std::size_t first, std::size_t end) {
    return first < end ? stretch{layers[first].begin, layers[end - 1].end} : stretch{};
  };
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t begin = cuts[k], end = cuts[k + 1];
    const std::int32_t own = lock_of(k), other = lock_of(k + 1 == n ? 0 : k + 1);
    slab& s = slabs[k];
    s[0] = cells(begin, begin + 1);
    if (end - begin == 1) {
      s[0].low = std::min(own, other);
      s[0].high = std::max(own, other);
    } else {
      s[0].low = own;
      s[1] = cells(begin + 1, end - 1);
      s[2] = cells(end - 1, end);
      s[2].low = other;
    }
  }
  return slabs;
}

/// What a sweep does in a layer, in candidates of its fluid particles.
template <int D>
std::uint64_t candidates_in(const cells<D>& c, const cell_layer& layer) {
  std::uint64_t work = 0;
  for (std::size_t cell = layer.begin; cell < layer.end; ++cell) {
    const std::uint64_t own = c.range[cell].fluid.size();
    std::uint64_t others = own / 2;
    for (unsigned n = 0; n < cells<D>::stencil; ++n) {
      const cell_range& other = c.range[c.neighbour(cell, n)];
      others += other.boundary.size() + (n > pattern::stencil_centre<D> ? other.fluid.size() : 0);
    }
    work += own * others;
  }
  return work;
}

}  // namespace pairsum
