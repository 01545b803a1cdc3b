#include "grid/indexer.hpp"

#include <algorithm>
#include <array>

namespace pairsum {

template <int D, class R>
void indexer<D, R>::build(particle_set<D, R>& p, const team& t) {
  grid_->adapt(p, t);
  make_keys(p, t);
  sort(p, t);
  make_cells(t);
}

template <int D, class R>
void indexer<D, R>::make_keys(particle_set<D, R>& p, const team& t) {
  keys_.resize(p.size());
  const int kind_shift = grid_->key_bits();
  struct alignas(64) tally {
    std::size_t fluid = 0, boundary = 0, lost = 0;
  };
  std::vector<tally> tallies(static_cast<std::size_t>(t.threads()));
  t.for_pieces(p.size(), [&](std::size_t begin, std::size_t end, std::size_t piece) {
    tally count;
    grid_->keys(p, begin, end, keys_);
    for (std::size_t i = begin; i < end; ++i) {
      bool inside = true;
      for (int d = 0; d < D; ++d) inside = inside && p.x[d][i] >= omega_.low[d] && p.x[d][i] <= omega_.high[d];
      if (!inside && p.kind[i] != particle_kind::lost) {
        p.kind[i] = particle_kind::lost;
        ++count.lost;
      }
      const auto kind = p.kind[i];
      count.fluid += kind == particle_kind::fluid;
      count.boundary += kind == particle_kind::boundary;
      const std::uint32_t cell = kind == particle_kind::lost ? 0 : keys_[i];
      keys_[i] = cell | static_cast<std::uint32_t>(kind) << kind_shift;
    }
    tallies[piece] = count;
  });
  fluid_ = boundary_ = lost_ = 0;
  for (const tally& a : tallies) {
    fluid_ += a.fluid;
    boundary_ += a.boundary;
    lost_ += a.lost;
  }
}

/// Boundary particles do not move, so after the first build [fluid_, size) is in order and only the fluid is sorted
/// again.
template <int D, class R>
void indexer<D, R>::sort(particle_set<D, R>& p, const team& t) {
  const auto ascending = [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> fine(static_cast<std::size_t>(t.threads()), 1);
    t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
      b += begin, e = std::min(e + begin + 1, end);
      std::uint8_t ok = 1;
      for (std::size_t k = b + 1; k < e; ++k) ok &= keys_[k - 1] <= keys_[k];
      fine[piece] = ok;
    });
    return std::ranges::count(fine, 0) == 0;
  };
  const std::uint32_t first_boundary_key = std::uint32_t{1} << grid_->key_bits();
  const bool tail_in_order =
      ascending(fluid_, p.size()) &&
      (fluid_ == p.size() || keys_[fluid_] >= first_boundary_key);  // then [0, fluid_) is all fluid
  const std::size_t end = tail_in_order ? fluid_ : p.size();
  if (ascending(0, end)) return;
  counting_sort_.sort({keys_.data(), end}, grid_->key_bits() + (tail_in_order ? 0 : 2), t);
  reorder_.apply(p, counting_sort_.order(), t);
  reorder_.apply(keys_, counting_sort_.order(), t);
}

/// Indices in [begin, end) at which a new key starts.
template <int D, class R>
std::vector<std::uint32_t> indexer<D, R>::starts(std::size_t begin, std::size_t end, const team& t) const {
  const auto is_start = [&](std::size_t k) { return k == begin || keys_[k - 1] != keys_[k]; };
  std::vector<std::size_t> offset(static_cast<std::size_t>(t.threads()) + 1, 0);
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    std::size_t n = 0;
    for (std::size_t k = begin + b; k < begin + e; ++k) n += is_start(k);
    offset[piece + 1] = n;
  });
  for (std::size_t piece = 1; piece < offset.size(); ++piece) offset[piece] += offset[piece - 1];
  std::vector<std::uint32_t> result(offset.back());
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    std::size_t n = offset[piece];
    for (std::size_t k = begin + b; k < begin + e; ++k)
      if (is_start(k)) result[n++] = static_cast<std::uint32_t>(k);
  });
  return result;
}

template <int D, class R>
void indexer<D, R>::make_cells(const team& t) {
  const auto fluid_starts = starts(0, fluid_, t);
  const auto boundary_starts = starts(fluid_, fluid_ + boundary_, t);
  const std::uint32_t cell_mask = (std::uint32_t{1} << grid_->key_bits()) - 1;
  auto end_of = [](const std::vector<std::uint32_t>& s, std::size_t k, std::size_t end) {
    return k + 1 < s.size() ? s[k + 1] : static_cast<std::uint32_t>(end);
  };
  cells_.fluid_cells = fluid_starts.size();
  cells_.range.clear();
  cells_.range.resize(fluid_starts.size() + 1);
  cell_keys_.assign(fluid_starts.size() + 1, 0);
  cells_.range[0] = {};
  for (std::size_t k = 0; k < fluid_starts.size(); ++k) {
    cells_.range[k + 1] = {fluid_starts[k], end_of(fluid_starts, k, fluid_), 0, 0};
    cell_keys_[k + 1] = keys_[fluid_starts[k]];
  }
  std::size_t c = 1;  // walks the fluid cells in step with the boundary cells: both ascend by key
  for (std::size_t k = 0; k < boundary_starts.size(); ++k) {
    const std::uint32_t begin = boundary_starts[k], end = end_of(boundary_starts, k, fluid_ + boundary_);
    const std::uint32_t key = keys_[begin] & cell_mask;
    while (c <= cells_.fluid_cells && cell_keys_[c] < key) ++c;
    if (c <= cells_.fluid_cells && cell_keys_[c] == key) {
      cells_.range[c].boundary_begin = begin;
      cells_.range[c].boundary_end = end;
    } else {
      cells_.range.push_back({0, 0, begin, end});
      cell_keys_.push_back(key);
    }
  }
  grid_->connect(cell_keys_, cells_, t);
  cells_.total = grid_->total_cells();
}

template class indexer<1, double>;
template class indexer<2, double>;
template class indexer<3, double>;
template class indexer<1, float>;
template class indexer<2, float>;
template class indexer<3, float>;

}  // namespace pairsum
