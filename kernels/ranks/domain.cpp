#include <pairsum/ranks/domain.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <mpi.h>

#include <pairsum/ranks/places_of_ids.hpp>
#include <pairsum/ranks/records.hpp>
#include <pairsum/sum/omega.hpp>
#include <pairsum/sum/rate_copies.hpp>

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

template <int D, class R>
std::array<double, 3> in_double(const vec<D, R>& x) {
  std::array<double, 3> place{};
  for (int d = 0; d < D; ++d) place[static_cast<std::size_t>(d)] = static_cast<double>(x[d]);
  return place;
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
      skin_(skin),
      near_(D, in_double(omega_.low), in_double(omega_.high), omega_.periodic, widened(omega_, reach + skin)) {}

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
  fluid_ = state_.particles().size();
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
      points.x.push_back(in_double(p.position(i)));
      points.weight.push_back(candidates[i]);
    }
  partition_.cut(points);
  near_.find(partition_.boxes(), own_rank());
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
    const int rank =
        inside ? here : partition_.rank_of(in_double(p.position(i)));  // on a face the partition says whose it is
    (rank == here ? keep : leave).push_back(static_cast<std::uint32_t>(i));
    if (rank != here) to.push_back(rank);
  }
  const exchange plan(std::move(to));
  const auto columns = columns_of(p);
  const auto records = plan.forward(packed(columns, leave), record_bytes(columns), count);
  if (!leave.empty() || !records.empty()) replace_fluid(keep, records, false);
}

template <int D, class R>
void domain<D, R>::replace_fluid(const std::vector<std::uint32_t>& keep, const std::vector<std::byte>& records,
                                 bool ghosts) {
  auto& p = state_.particles();
  const std::size_t more = records.size() / record_bytes(columns_of(p)), now = keep.size() + more,
                    tail = p.size() - fluid_;
  if (now > fluid_) p.resize(now + tail);
  p.each_column([&](auto& c) {
    for (std::size_t k = 0; k < keep.size(); ++k) c[k] = c[keep[k]];  // what stays moves down
    if (now != fluid_) std::memmove(c.data() + now, c.data() + fluid_, tail * sizeof c[0]);
  });
  p.resize(now + tail);
  unpack(columns_of(p), records, [&](std::size_t k) { return keep.size() + k; });
  if (ghosts)
    std::fill(p.kind.begin() + static_cast<std::ptrdiff_t>(keep.size()),
              p.kind.begin() + static_cast<std::ptrdiff_t>(now), particle_kind::ghost);
  fluid_ = now;
  state_.forget_index();
}

/// Each rank keeps a share of the boundary at home and sends copies from there.
template <int D, class R>
void domain<D, R>::copy_boundary(traffic& count) {
  std::vector<std::uint32_t> list;
  std::vector<int> to;
  for (std::size_t i = 0; i < home_.size(); ++i)
    near_.each(in_double(home_.position(i)), [&](int rank) {
      list.push_back(static_cast<std::uint32_t>(i));
      to.push_back(rank);
    });
  auto& p = state_.particles();
  home_.carry(p.carried.size());
  const exchange plan(std::move(to));
  std::vector<std::uint32_t> lost;
  for (std::size_t i = fluid_; i < p.size(); ++i)
    if (p.kind[i] == particle_kind::lost) lost.push_back(static_cast<std::uint32_t>(i));
  const auto columns = columns_of(home_);
  auto records = plan.forward(packed(columns, list), record_bytes(columns), count);
  const auto of_lost = packed(columns_of(p), lost);
  records.insert(records.end(), of_lost.begin(), of_lost.end());
  p.resize(fluid_ + records.size() / record_bytes(columns));
  unpack(columns_of(p), records, [&](std::size_t k) { return fluid_ + k; });
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
    if (!omega_.contains(p.position(i))) continue;  // what is outside the index will lose
    near_.each_near(in_double(p.position(i)), [&](int rank) {
      if (rank == here) return;
      list.push_back(static_cast<std::uint32_t>(i));
      to.push_back(rank);
    });
  }
  exchange_ = exchange(std::move(to));
  const auto columns = columns_of(p);
  const auto records = exchange_.forward(packed(columns, list), record_bytes(columns), haloed_);
  halo_ids_.resize(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) halo_ids_[k] = p.id[list[k]];
  replace_fluid(own, records, true);
  own_ = own.size();
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
  std::vector<byte_column> columns;
  const auto add = [&](column<R>& c) { columns.push_back({reinterpret_cast<std::byte*>(c.data()), sizeof(R)}); };
  for (auto& c : p.x) add(c);
  for (auto& c : p.v) add(c);
  add(p.rho);
  const auto got = exchange_.forward(packed(columns, halo_places_), record_bytes(columns), haloed_);
  unpack(columns, got, [&](std::size_t k) { return ghost_places_[k]; });
}

template <int D, class R>
void domain<D, R>::send_back() {
  find_places();
  const rate_columns rates = state_.columns_of_rates();
  const auto columns_at = [&](const rate_view& view) {
    std::vector<byte_column> columns;
    for (std::size_t c = 0; c < rates.bytes.size(); ++c)
      columns.push_back({static_cast<std::byte*>(view.begin[c]), rates.bytes[c]});
    return columns;
  };
  const auto columns = columns_at(rates.view);
  const auto got = exchange_.back(packed(columns, ghost_places_), record_bytes(columns), sent_back_);
  rate_copy more;
  more.resize(rates.bytes, halo_places_.size());
  unpack(columns_at(more.view()), got, [](std::size_t k) { return k; });
  for (std::size_t k = 0; k < halo_places_.size(); ++k) rates.add(rates.view, halo_places_[k], more.view(), k, 1);
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
