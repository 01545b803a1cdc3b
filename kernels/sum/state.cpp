#include <pairsum/sum/state.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/grid/cell_scale.hpp>
#include <pairsum/sum/check.hpp>
#include <pairsum/sum/grids.hpp>

namespace pairsum {
namespace {

/// A grid of cells that are wider by a skin; says so where that is what does not fit.
template <int D, class R>
std::unique_ptr<grid<D, R>> grid_with_skin(const setup& s, double skin) {
  try {
    return make_grid<D, R>(with_skin(s, skin));
  } catch (const error& e) {
    if (skin == 0) throw;
    throw error(std::string(e.what()) + " (backend " + s.backend + " takes the support radius and a skin of " +
                number_text(skin) + " H for one)");
  }
}

}  // namespace

template <int D, class R>
state<D, R>::state(const setup& s, double skin)
    : setup_((check_domain(s), s)), index_(make_box<D, R>(s), grid_with_skin<D, R>(s, skin)) {}

template <int D, class R>
state<D, R>::~state() = default;

template <int D, class R>
void state<D, R>::load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) {
  check(p);
  check_order(order, p.size());
  fill(particles_, p, order, t);
  index_.forget();
  rows_total_ = p.size();
  lost_ = 0;
}

template <int D, class R>
void state<D, R>::load_some(const particle_table& p, const std::vector<std::uint32_t>& ids) {
  particles_.resize(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) copy_row(particles_, k, p, ids[k]);
  index_.forget();
  rows_total_ = p.size();
  lost_ = 0;
}

template <int D, class R>
void state<D, R>::sum_ghosts(cut_pairs pairs) {
  if (pairs == cut_pairs::once && !this->traits().symmetric)
    throw error("backend " + std::string(this->traits().name) +
                " sums one side of each pair, so it cannot sum the pairs between ranks once: use twice");
  ghosts_.pairs = pairs;
  index_.expect_ghosts();
}

template <int D, class R>
void state<D, R>::check(const particle_table& p) const {
  check_input(p, setup_);
}

template <int D, class R>
void state<D, R>::index(const team& t) {
  index_.build(particles_, t);
  lost_ += index_.lost();
  if (ghosts_.pairs == cut_pairs::none) return;
  ghosts_.kind = particles_.kind.data();
  ghosts_.id = particles_.id.data();
  ghosts_.mark(index_.view(), index_.fluid(), t);
}

template <int D, class R>
std::optional<unfolded_tests> state<D, R>::count_unfolded_tests() const {
  setup unfolded = setup_;
  unfolded.grid = "compact_grid";
  const box<D, R> omega = make_box<D, R>(unfolded);
  if (!resolves(omega, static_cast<R>(unfolded.constants.H))) return std::nullopt;
  particle_set<D, R> particles = particles_;
  indexer<D, R> index(omega, make_grid<D, R>(unfolded));
  index.build(particles, team());
  const cells<D>& c = index.view();
  unfolded_tests tests;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    const std::uint64_t own = c.range[cell].fluid.size();
    std::uint64_t around = 0, boundary = 0;
    for (unsigned n = 0; n < cells<D>::stencil; ++n) {
      const cell_range& other = c.range[c.neighbour(cell, n)];
      around += other.fluid.size();
      boundary += other.boundary.end - other.boundary.begin;
    }
    tests.gather += own * (around - 1) + own * boundary;
    tests.symmetric += own * boundary;
  }
  // Each fluid pair is tested twice by the gather, once by a symmetric sum.
  tests.symmetric += (tests.gather - tests.symmetric) / 2;
  return tests;
}

template <int D, class R>
particle_table state<D, R>::snapshot() const {
  particle_table table = to_table(particles_, rows_total_);
  const box<D, double> omega = make_box<D, double>(setup_);
  for (int d = 0; d < D; ++d) {
    if (!omega.periodic[d]) continue;
    for (double& x : table.x[static_cast<std::size_t>(d)])  // while a list serves, nobody is brought back
      if (std::isfinite(x)) x = omega.wrapped(d, x);
  }
  return table;
}

template <int D, class R>
std::vector<std::uint32_t> state<D, R>::not_finite() const {
  std::vector<std::uint32_t> ids;
  const auto look = [&](const column<R>& c) {
    for (std::size_t k = 0; k < c.size(); ++k)
      if (!std::isfinite(c[k]) && particles_.kind[k] != particle_kind::ghost) ids.push_back(particles_.id[k]);
  };
  for (const auto& c : particles_.x) look(c);
  for (const auto& c : particles_.v) look(c);
  look(particles_.rho);
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());  // clang 14 cannot take std::ranges::unique
  return ids;
}

#define PAIRSUM_STATES(D, R) template class state<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_STATES)

}  // namespace pairsum
