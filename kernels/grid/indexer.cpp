#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/grid/indexer.hpp>

#include <algorithm>
#include <array>

namespace pairsum {
namespace {

constexpr std::size_t chunk = 1024;  // of particles, whose keys stay in the first cache

/// With more movers than 1 in so many sorting everything takes less time.
constexpr std::size_t few = 6;

}  // namespace

template <int D, class R>
void indexer<D, R>::build(particle_set<D, R>& p, const team& t) {
  lost_ = 0;
  const bool all = !known_ || keys_.size() != p.size();
  known_ = false;  // until this build has come to its end
  if (omega_.periodic.any()) bring_back(p, all ? p.size() : fluid_, t);
  const bool renumbered = grid_->adapt(p, all ? p.size() : fluid_, t);
  if (cell_bits() > 30)
    throw error(
        "ghosts take a bit of a cell's number, and a grid of 2^30 cells leaves none: use a smaller M or another grid");
  bool boundary_kept = false;
  if (all || renumbered) {
    make_keys(p, t);
    sort(p, t);
  } else {
    find_movers(p, t);
    if (movers_.empty()) {
      known_ = true;
      return;
    }
    boundary_kept = lost_ == 0;
    const std::size_t end = lost_ == 0 ? fluid_ : p.size();
    fluid_ -= lost_;
    if (movers_.size() * few <= end) {
      merge_.make({keys_.data(), end}, movers_, cell_bits() + 2, t);
      for (const mover& m : movers_) keys_[m.from] = m.key;
      merge_.apply(keys_, t);
      merge_.apply(p, t);
    } else {
      for (const mover& m : movers_) keys_[m.from] = m.key;
      sort(p, t);
    }
  }
  ranges_.make(keys_, ghost_bits_, fluid_, boundary_, boundary_kept, renumbered, *grid_, t);
  known_ = true;
}

/// Moves the first `end` particles into [low, high) along the periodic axes.
template <int D, class R>
void indexer<D, R>::bring_back(particle_set<D, R>& p, std::size_t end, const team& t) const {
  t.for_pieces(end, [&](std::size_t first, std::size_t last, std::size_t) {
    for (int d = 0; d < D; ++d) {
      if (!omega_.periodic[d]) continue;
      R* const x = p.x[d].data();
      for (std::size_t i = first; i < last; ++i)
        if (!(x[i] >= omega_.low[d] && x[i] < omega_.high[d])) [[unlikely]]
          x[i] = omega_.wrapped(d, x[i]);
    }
  });
}

/// Are particles begin..end in Omega, or between its faces along these axes alone?
template <int D, class R>
bool indexer<D, R>::inside(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const axes& along) const {
  unsigned out = 0;
  for (int d = 0; d < D; ++d) {
    if (!along[d]) continue;
    const R* const x = p.x[d].data();
    const R low = omega_.low[d], high = omega_.high[d];
    for (std::size_t i = begin; i < end; ++i) out |= !(unsigned(x[i] >= low) & unsigned(x[i] <= high));
  }
  return out == 0;
}

template <int D, class R>
bool indexer<D, R>::holds(const particle_set<D, R>& p, const team& t) const {
  if (!known_ || keys_.size() != p.size()) return false;
  axes open;
  for (int d = 0; d < D; ++d) open.on[static_cast<std::size_t>(d)] = !omega_.periodic[d];
  if (!open.any()) return true;
  std::vector<std::uint8_t> in(static_cast<std::size_t>(t.threads()), 1);
  t.for_pieces(fluid_,
               [&](std::size_t begin, std::size_t end, std::size_t piece) { in[piece] = inside(p, begin, end, open); });
  return std::ranges::count(in, 0) == 0;
}

/// The keys of a chunk of particles, their kind in the highest bits. Those that are outside Omega become lost.
template <int D, class R>
void indexer<D, R>::keys_of(particle_set<D, R>& p, std::size_t begin, std::size_t end, std::uint32_t* out,
                            std::size_t& lost) const {
  grid_->keys(p, begin, end, {out, end - begin});
  if (!inside(p, begin, end))
    for (std::size_t i = begin; i < end; ++i)
      if (p.kind[i] != particle_kind::lost && !omega_.contains(p.position(i))) {
        p.kind[i] = particle_kind::lost;
        ++lost;
      }
  const int kind_shift = cell_bits();
  if (ghost_bits_ > 0)
    for (std::size_t i = begin; i < end; ++i)
      out[i - begin] = out[i - begin] << 1 | static_cast<std::uint32_t>(p.kind[i] == particle_kind::ghost);
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t cell = p.kind[i] == particle_kind::lost ? 0 : out[i - begin];
    out[i - begin] = cell | place_of(p.kind[i]) << kind_shift;
  }
}

template <int D, class R>
void indexer<D, R>::make_keys(particle_set<D, R>& p, const team& t) {
  keys_.resize(p.size());
  struct alignas(64) tally {
    std::size_t fluid = 0, boundary = 0, lost = 0;
  };
  std::vector<tally> tallies(static_cast<std::size_t>(t.threads()));
  t.for_pieces(p.size(), [&](std::size_t begin, std::size_t end, std::size_t piece) {
    tally count;
    for (; begin < end; begin += chunk) {
      const std::size_t stop = std::min(begin + chunk, end);
      keys_of(p, begin, stop, keys_.data() + begin, count.lost);
      for (std::size_t i = begin; i < stop; ++i) {
        count.fluid += place_of(p.kind[i]) == place_of(particle_kind::fluid);
        count.boundary += p.kind[i] == particle_kind::boundary;
      }
    }
    tallies[piece] = count;
  });
  fluid_ = boundary_ = 0;
  for (const tally& a : tallies) {
    fluid_ += a.fluid;
    boundary_ += a.boundary;
    lost_ += a.lost;
  }
}

/// The fluid particles whose keys are not what they were, in the order of memory; keys_ is left as it is.
template <int D, class R>
void indexer<D, R>::find_movers(particle_set<D, R>& p, const team& t) {
  struct alignas(64) found {
    std::vector<mover> movers;
    std::size_t lost = 0;
  };
  std::vector<found> parts(static_cast<std::size_t>(t.threads()));
  t.for_pieces(fluid_, [&](std::size_t begin, std::size_t end, std::size_t piece) {
    found& own = parts[piece];
    std::array<std::uint32_t, chunk> now;
    for (; begin < end; begin += chunk) {
      const std::size_t n = std::min(chunk, end - begin);
      keys_of(p, begin, begin + n, now.data(), own.lost);
      const std::uint32_t* const before = keys_.data() + begin;
      std::uint32_t changed = 0;
      for (std::size_t k = 0; k < n; ++k) changed |= now[k] ^ before[k];
      if (changed == 0) continue;
      for (std::size_t k = 0; k < n; ++k)
        if (now[k] != before[k]) own.movers.push_back({static_cast<std::uint32_t>(begin + k), now[k]});
    }
  });
  movers_.clear();
  for (const found& f : parts) {
    movers_.insert(movers_.end(), f.movers.begin(), f.movers.end());
    lost_ += f.lost;
  }
}

template <int D, class R>
bool indexer<D, R>::ascending(std::size_t begin, std::size_t end, const team& t) const {
  std::vector<std::uint8_t> fine(static_cast<std::size_t>(t.threads()), 1);
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    b += begin, e = std::min(e + begin + 1, end);
    std::uint8_t ok = 1;
    for (std::size_t k = b + 1; k < e; ++k) ok &= keys_[k - 1] <= keys_[k];
    fine[piece] = ok;
  });
  return std::ranges::count(fine, 0) == 0;
}

/// Sorts everything, or the fluid alone if the rest is in order.
template <int D, class R>
void indexer<D, R>::sort(particle_set<D, R>& p, const team& t) {
  const std::uint32_t first_boundary_key = std::uint32_t{1} << cell_bits();
  const bool tail_in_order =
      ascending(fluid_, p.size(), t) &&
      (fluid_ == p.size() || keys_[fluid_] >= first_boundary_key);  // then [0, fluid_) is all fluid
  const std::size_t end = tail_in_order ? fluid_ : p.size();
  if (ascending(0, end, t)) return;
  counting_sort_.sort({keys_.data(), end}, cell_bits() + (tail_in_order ? 0 : 2), t);
  reorder_.apply(p, counting_sort_.order(), t);
  reorder_.apply(keys_, counting_sort_.order(), t);
}

#define PAIRSUM_INDEXER(D, R) template class indexer<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_INDEXER)

}  // namespace pairsum
