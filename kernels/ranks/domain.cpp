#include <pairsum/ranks/domain.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <mpi.h>

#include <pairsum/ranks/places_of_ids.hpp>
#include <pairsum/ranks/records.hpp>
#include <pairsum/sum/omega.hpp>

namespace pairsum::ranks {
namespace {

/// Farther than `reach` by what rounding can do to a difference of positions in Omega.
template <int D, class R>
double widened(const box<D, R>& omega, double reach) {
  double far = reach;
  for (int d = 0; d < D; ++d)
    far = std::max({far, std::abs(static_cast<double>(omega.low[d])), std::abs(static_cast<double>(omega.high[d]))});
  return reach + 8 * static_cast<double>(std::numeric_limits<R>::epsilon()) * far;
}

int own_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

}  // namespace

template <int D, class R>
domain<D, R>::domain(state<D, R>& s, double reach, double skin)
    : state_(s),
      omega_(make_box<D, R>(s.settings())),
      torus_(omega_, static_cast<R>(reach + skin)),
      reach_(widened(omega_, reach + skin)),
      skin_(skin) {}

template <int D, class R>
typename domain<D, R>::place domain<D, R>::position(const particle_set<D, R>& p, std::size_t i) const {
  place x{};
  for (int d = 0; d < D; ++d) x[static_cast<std::size_t>(d)] = static_cast<double>(p.x[d][i]);
  return x;
}

template <int D, class R>
void domain<D, R>::load(const particle_table& p, const std::vector<std::uint32_t>& order, balance weights) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto rank = static_cast<std::size_t>(own_rank()), all = static_cast<std::size_t>(ranks);
  std::vector<std::uint32_t> fluid, boundary;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::uint32_t id = order.empty() ? static_cast<std::uint32_t>(k) : order[k];
    if (p.kind[id] == particle_kind::fluid) fluid.push_back(id);
    if (p.kind[id] == particle_kind::boundary) boundary.push_back(id);
  }
  const auto share = [&](const std::vector<std::uint32_t>& ids) {
    return std::vector<std::uint32_t>(ids.begin() + static_cast<std::ptrdiff_t>(ids.size() * rank / all),
                                      ids.begin() + static_cast<std::ptrdiff_t>(ids.size() * (rank + 1) / all));
  };
  state_.particles().since.clear();  // of an earlier load; boundary at home has no such columns
  state_.load_some(p, share(boundary));
  home_ = state_.particles();
  wrap(home_, home_.size());
  state_.load_some(p, share(fluid));
  fluid_ = own_ = state_.particles().size();
  exchange_ = exchange();
  cut(weights);
}

template <int D, class R>
void domain<D, R>::cut(balance weights) {
  count_fluid();
  wrap(state_.particles(), fluid_);
  const auto& p = state_.particles();
  const auto& c = state_.view();
  std::vector<float> candidates(p.size(), 1.0F);
  int known = fluid_ == state_.fluid_count();  // the index is that of these particles
  MPI_Allreduce(MPI_IN_PLACE, &known, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (weights == balance::pairs && known != 0)
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
      std::uint32_t around = 0;
      for (unsigned n = 0; n < cells<D>::stencil; ++n) {
        const cell_range& other = c.range[c.neighbour(cell, n)];
        around += other.fluid.size() + other.boundary.size();
      }
      const index_range& own = c.range[cell].fluid;
      std::fill(candidates.begin() + own.begin, candidates.begin() + own.end, static_cast<float>(around));
    }
  weighted_points points{D, {}, {}};
  for (std::size_t i = 0; i < fluid_; ++i)
    if (p.kind[i] == particle_kind::fluid) {
      points.x.push_back(position(p, i));
      points.weight.push_back(candidates[i]);
    }
  partition_.cut(points);
  find_near_boxes();
  state_.particles().since.clear();
  move_to_owners(partitioned_);
  copy_boundary(partitioned_);
}

/// Moves the first n particles into the domain along periodic axes, but ghosts, which their owners move.
template <int D, class R>
void domain<D, R>::wrap(particle_set<D, R>& p, std::size_t n) const {
  for (int d = 0; d < D; ++d)
    if (omega_.periodic[d])
      for (std::size_t i = 0; i < n; ++i)
        if (p.kind[i] != particle_kind::ghost) p.x[d][i] = omega_.wrapped(d, p.x[d][i]);
}

template <int D, class R>
void domain<D, R>::move_to_owners(traffic& count) {
  auto& p = state_.particles();
  wrap(p, fluid_);
  std::vector<std::uint32_t> keep, leave;
  std::vector<int> to;
  const int here = own_rank();
  const auto& [low, high] = partition_.boxes()[static_cast<std::size_t>(here)];
  for (std::size_t i = 0; i < fluid_; ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    bool inside = true;
    for (int d = 0; d < D; ++d) {
      const double x = static_cast<double>(p.x[d][i]);
      inside = inside && x > low[static_cast<std::size_t>(d)] && x < high[static_cast<std::size_t>(d)];
    }
    const int rank = inside ? here : partition_.rank_of(position(p, i));  // on a face the partition says whose it is
    (rank == here ? keep : leave).push_back(static_cast<std::uint32_t>(i));
    if (rank != here) to.push_back(rank);
  }
  const exchange plan(std::move(to));
  const auto records = plan.forward(packed(p, leave), record_bytes(p), count);
  if (!leave.empty() || !records.empty() || &count == &partitioned_) replace_fluid(keep, records, false);
}

template <int D, class R>
void domain<D, R>::replace_fluid(const std::vector<std::uint32_t>& keep, const std::vector<std::byte>& records,
                                 bool ghosts) {
  auto& p = state_.particles();
  const std::size_t more = records.size() / record_bytes(p), now = keep.size() + more, tail = p.size() - fluid_;
  if (now > fluid_) p.resize(now + tail);
  p.each_column([&](auto& c) {
    for (std::size_t k = 0; k < keep.size(); ++k) c[k] = c[keep[k]];  // what stays moves down
    if (now != fluid_) std::memmove(c.data() + now, c.data() + fluid_, tail * sizeof c[0]);
  });
  p.resize(now + tail);
  unpack(p, records, [&](std::size_t k) { return keep.size() + k; });
  if (ghosts)
    std::fill(p.kind.begin() + static_cast<std::ptrdiff_t>(keep.size()),
              p.kind.begin() + static_cast<std::ptrdiff_t>(now), particle_kind::ghost);
  fluid_ = now;
  if (!ghosts) own_ = now;
  state_.forget_index();
}

/// All boxes with their images through periodic faces, and those of them that this rank's box is near.
template <int D, class R>
void domain<D, R>::find_near_boxes() {
  near_.clear();
  everywhere_.clear();
  const int here = own_rank();
  const auto& boxes = partition_.boxes();
  const rank_box& own = boxes[static_cast<std::size_t>(here)];
  constexpr unsigned images = pattern::stencil_cells<D>;
  for (std::size_t rank = 0; rank < boxes.size(); ++rank)
    for (unsigned image = 0; image < images; ++image) {
      near_box b{static_cast<int>(rank), boxes[rank].low, boxes[rank].high};
      bool exists = true, meets_own = true;
      unsigned code = image;
      for (int d = 0; d < D; ++d, code /= 3) {
        const auto a = static_cast<std::size_t>(d);
        const int turns = static_cast<int>(code % 3) - 1;
        exists = exists && (turns == 0 || omega_.periodic[d]);
        if (omega_.periodic[d]) {  // a box without an end ends at the faces
          b.low[a] = std::max(b.low[a], static_cast<double>(omega_.low[d]));
          b.high[a] = std::min(b.high[a], static_cast<double>(omega_.high[d]));
        }
        const double by = turns * static_cast<double>(omega_.edge(d));
        b.low[a] += by - reach_;
        b.high[a] += by + reach_;
        meets_own = meets_own && b.low[a] <= own.high[a] && b.high[a] >= own.low[a];
      }
      if (!exists) continue;
      everywhere_.push_back(b);
      if (meets_own && (b.rank != here || image != images / 2)) near_.push_back(b);
    }
}

template <int D, class R>
template <class F>
void domain<D, R>::each_rank_near(const place& x, std::span<const near_box> boxes, F&& f) {
  found_.clear();
  for (const near_box& b : boxes) {
    bool inside = true;
    for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d)
      inside = inside && x[d] >= b.low[d] && x[d] <= b.high[d];
    if (inside) found_.push_back(b.rank);
  }
  if (found_.size() > 1) {  // through several faces
    std::ranges::sort(found_);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  }
  for (const int rank : found_) f(rank);
}

/// Each rank keeps a share of the boundary at home and sends copies from there.
template <int D, class R>
void domain<D, R>::copy_boundary(traffic& count) {
  std::vector<std::uint32_t> list;
  std::vector<int> to;
  for (std::size_t i = 0; i < home_.size(); ++i)
    each_rank_near(position(home_, i), everywhere_, [&](int rank) {
      list.push_back(static_cast<std::uint32_t>(i));
      to.push_back(rank);
    });
  auto& p = state_.particles();
  home_.carry(p.carried.size());
  const exchange plan(std::move(to));
  std::vector<std::uint32_t> lost;
  for (std::size_t i = fluid_; i < p.size(); ++i)
    if (p.kind[i] == particle_kind::lost) lost.push_back(static_cast<std::uint32_t>(i));
  auto records = plan.forward(packed(home_, list), record_bytes(home_), count);
  const auto of_lost = packed(p, lost);
  records.insert(records.end(), of_lost.begin(), of_lost.end());
  p.resize(fluid_ + records.size() / record_bytes(p));
  unpack(p, records, [&](std::size_t k) { return fluid_ + k; });
  state_.forget_index();
}

template <int D, class R>
void domain<D, R>::count_fluid() {
  const auto& kind = state_.particles().kind;
  while (fluid_ > 0 && place_of(kind[fluid_ - 1]) != place_of(particle_kind::fluid)) --fluid_;
}

template <int D, class R>
void domain<D, R>::update() {
  auto& p = state_.particles();
  count_fluid();
  if (!has_moved()) return refresh();
  p.since.clear();
  migrate();
  halo();
  if (skin_ > 0) p.since.assign(p.x.begin(), p.x.end());
}

template <int D, class R>
bool domain<D, R>::has_moved() const {
  const auto& p = state_.particles();
  // 2 % of the half are for rounding, and what a difference through the faces of a periodic box is rounded by.
  const R limit = R(0.49 * skin_) - 2 * torus_.rounding();
  int moved = p.since.empty() || !(limit > 0);
  for (std::size_t i = 0; i < fluid_ && moved == 0; ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    vec<D, R> by;
    bool inside = true;
    for (int d = 0; d < D; ++d) {
      by[d] = p.x[d][i] - p.since[static_cast<std::size_t>(d)][i];
      inside = inside && (omega_.periodic[d] || (p.x[d][i] >= omega_.low[d] && p.x[d][i] <= omega_.high[d]));
    }
    if (torus_.periodic) torus_.to_minimum_image(by);
    moved = !(inside && norm2<D, R>(by) <= limit * limit);  // also if it is not finite
  }
  MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return moved != 0;
}

template <int D, class R>
void domain<D, R>::halo() {
  auto& p = state_.particles();
  std::vector<std::uint32_t> list, own;
  std::vector<int> to;
  const int here = own_rank();
  for (std::size_t i = 0; i < fluid_; ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    own.push_back(static_cast<std::uint32_t>(i));
    if (near_.empty() || !omega_.contains(p.position(i))) continue;  // what is outside the index will lose
    each_rank_near(position(p, i), near_, [&](int rank) {
      if (rank == here) return;
      list.push_back(static_cast<std::uint32_t>(i));
      to.push_back(rank);
    });
  }
  exchange_ = exchange(std::move(to));
  const auto records = exchange_.forward(packed(p, list), record_bytes(p), haloed_);
  halo_ids_.resize(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) halo_ids_[k] = p.id[list[k]];
  replace_fluid(own, records, true);
  const auto first = p.id.begin() + static_cast<std::ptrdiff_t>(own.size());
  ghost_ids_.assign(first, first + static_cast<std::ptrdiff_t>(exchange_.received()));
}

template <int D, class R>
void domain<D, R>::find_places() {
  const auto& p = state_.particles();
  const auto find = [&](const std::vector<std::uint32_t>& ids, std::vector<std::uint32_t>& places) {
    bool known = places.size() == ids.size();
    for (std::size_t k = 0; known && k < ids.size(); ++k) known = places[k] < fluid_ && p.id[places[k]] == ids[k];
    if (!known) places = places_of_ids({p.id.data(), fluid_}, ids);
  };
  find(halo_ids_, halo_places_);
  find(ghost_ids_, ghost_places_);
}

template <int D, class R>
void domain<D, R>::refresh() {
  auto& p = state_.particles();
  find_places();
  std::array<column<R>*, 2 * D + 1> columns;
  for (int d = 0; d < D; ++d) {
    columns[static_cast<std::size_t>(d)] = &p.x[d];
    columns[static_cast<std::size_t>(D + d)] = &p.v[d];
  }
  columns.back() = &p.rho;
  constexpr std::size_t bytes = sizeof(R) * (2 * D + 1);
  std::vector<std::byte> items(halo_places_.size() * bytes);
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t k = 0; k < halo_places_.size(); ++k)
      std::memcpy(items.data() + k * bytes + c * sizeof(R), columns[c]->data() + halo_places_[k], sizeof(R));
  const auto got = exchange_.forward(items, bytes, haloed_);
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t k = 0; k < ghost_places_.size(); ++k)
      std::memcpy(columns[c]->data() + ghost_places_[k], got.data() + k * bytes + c * sizeof(R), sizeof(R));
}

template <int D, class R>
void domain<D, R>::send_back() {
  find_places();
  const rate_columns rates = state_.columns_of_rates();
  std::size_t bytes = 0;
  for (const std::uint16_t b : rates.bytes) bytes += b;
  std::vector<std::byte> items(ghost_places_.size() * bytes);
  std::size_t offset = 0;
  for (std::size_t c = 0; c < rates.bytes.size(); offset += rates.bytes[c++]) {
    const auto* const column = static_cast<const std::byte*>(rates.view.begin[c]);
    for (std::size_t k = 0; k < ghost_places_.size(); ++k)
      std::memcpy(items.data() + k * bytes + offset, column + ghost_places_[k] * rates.bytes[c], rates.bytes[c]);
  }
  const auto got = exchange_.back(items, bytes, sent_back_);
  const std::size_t n = halo_places_.size();
  std::vector<std::vector<std::byte>> columns(rates.bytes.size());
  std::vector<void*> begin;
  offset = 0;
  for (std::size_t c = 0; c < columns.size(); offset += rates.bytes[c++]) {
    columns[c].resize(n * rates.bytes[c] + 1);
    for (std::size_t k = 0; k < n; ++k)
      std::memcpy(columns[c].data() + k * rates.bytes[c], got.data() + k * bytes + offset, rates.bytes[c]);
    begin.push_back(columns[c].data());
  }
  const rate_view from{begin.data(), 0};
  for (std::size_t k = 0; k < n; ++k) rates.add(rates.view, halo_places_[k], from, k, 1);
}

template <int D, class R>
rank_facts domain<D, R>::sent() {
  rank_facts f;
  f.partition = std::exchange(partitioned_, {});
  f.migrate = std::exchange(migrated_, {});
  f.halo = std::exchange(haloed_, {});
  f.send_back = std::exchange(sent_back_, {});
  return f;
}

#define PAIRSUM_DOMAINS(D, R) template class domain<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_DOMAINS)

}  // namespace pairsum::ranks
