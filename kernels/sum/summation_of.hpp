#pragma once
#include <memory>
#include <utility>

#include "grid/indexer.hpp"
#include "interactions/count.hpp"
#include "sum/check.hpp"
#include "sum/grids.hpp"
#include "sum/rate_names.hpp"
#include "sum/state.hpp"

namespace pairsum {

/// Columns of one interaction for one set of particles, and the problem that points to them.
template <interaction I>
class interaction_columns {
  using R = typename I::real;
  static constexpr int D = I::dim;

 public:
  explicit interaction_columns(const physics& constants) : formula_(constants), H_(static_cast<R>(constants.H)) {}

  /// Derives the per-particle terms of fluid [0, fluid) and boundary [fluid, fluid + boundary).
  void derive(const particle_set<D, R>& p, std::size_t fluid, std::size_t boundary, const team& t) {
    fluid_.resize(fluid);
    boundary_.resize(boundary);
    u_.resize(fluid);
    const auto to = fluid_.pointers();
    t.for_pieces(fluid, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) to.store(i, formula_.derive(state_of(p, i)));
    });
    const auto wall = boundary_.pointers();
    t.for_pieces(boundary, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) wall.store(i, formula_.derive_boundary(state_of(p, fluid + i)));
    });
  }

  void zero_rates(const team& t) {
    const auto u = u_.pointers();
    t.for_pieces(u_.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) u.store(i, zero<rates_of<I>>());
    });
  }

  field_pointers<rates_of<I>> rates() { return u_.pointers(); }

  problem<I> view(const particle_set<D, R>& p, const cells<D>& c) {
    problem<I> v{};
    for (int d = 0; d < D; ++d) v.x[d] = p.x[d].data();
    v.fluid = fluid_.pointers();
    v.boundary = boundary_.pointers();
    v.u = u_.pointers();
    v.grid_cells = &c;
    v.formula = &formula_;
    const R boundary_reach = static_cast<R>(I::boundary_reach) * H_;
    v.reach2 = H_ * H_;
    v.boundary_reach2 = boundary_reach * boundary_reach;
    v.fluid_count = fluid_.size();
    return v;
  }

 private:
  static particle_state<D, R> state_of(const particle_set<D, R>& p, std::size_t i) {
    return {p.position(i), p.velocity(i), p.rho[i], p.m[i], p.id[i]};
  }

  I formula_;
  R H_;
  field_columns<particle_of<I>> fluid_;
  field_columns<boundary_particle_of<I>> boundary_;
  field_columns<rates_of<I>> u_;
};

/// Counts the work of backend B on indexed particles, by summing `count` on one thread.
template <class B, int D, class R>
work_counts count_work_of(const particle_set<D, R>& p, const indexer<D, R>& index, const physics& constants) {
  using I = count<D, R>;
  interaction_columns<I> columns(constants);
  const team alone;
  columns.derive(p, index.fluid(), index.boundary(), alone);
  columns.zero_rates(alone);
  typename B::template workspace<I> workspace;
  work_probe probe;
  with_one_thread(B::traits.threads, [&](const team& one) {
    const auto view = columns.view(p, index.view());
    workspace.prepare(view, one, probe);
    workspace.sum(view, one, probe);
  });
  probe.counts.cells = index.view().total;
  probe.counts.cells_nonempty = index.view().nonempty();
  return probe.counts;
}

/// The adapter between the erased door and one backend with one interaction.
template <class B, interaction I>
requires backend<B, I>
class summation_of final : public state<I::dim, typename I::real> {
  using R = typename I::real;
  static constexpr int D = I::dim;
  using base = state<D, R>;
  using base::particles_;

 public:
  explicit summation_of(const setup& s)
      : setup_(s), index_(make_box<D, R>(s), make_grid<D, R>(s)), columns_(s.constants) {}

  const backend_traits& traits() const override { return B::traits; }

  void load(const particle_table& p, const std::vector<std::uint32_t>& order) override {
    check_input(p, setup_);
    check_order(order, p.size());
    fill(particles_, p, order);
    rows_ = p.size();
    lost_ = 0;
    view_ = {};
  }

  void index(const team& t) override {
    index_.build(particles_, t);
    lost_ += index_.lost();
  }
  void prepare(const team& t) override {
    columns_.derive(particles_, index_.fluid(), index_.boundary(), t);
    view_ = columns_.view(particles_, index_.view());
    no_probe none;
    workspace_.prepare(view_, t, none);
  }
  void zero(const team& t) override {
    if constexpr (B::traits.accumulates) columns_.zero_rates(t);
  }
  void sum(const team& t) override {
    no_probe none;
    workspace_.sum(view_, t, none);
  }
  void reduce(const team& t) override {
    if constexpr (requires { workspace_.reduce(view_, t); }) workspace_.reduce(view_, t);
  }

  work_counts count_work() override { return count_work_of<B>(particles_, index_, setup_.constants); }

  rate_table rates() const override {
    rate_table table;
    table.names = rate_names<rates_of<I>>();
    table.columns.assign(field_count<rates_of<I>>, std::vector<double>(rows_, 0.0));
    const auto u = view_.u;
    for (std::size_t i = 0; i < view_.fluid_count; ++i)
      each_scalar(u.load(i),
                  [&](const auto& a, int slot) { table.columns[slot][particles_.id[i]] = static_cast<double>(a); });
    return table;
  }

  std::uint64_t fingerprint() const override {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> place(rows_, none);
    for (std::uint32_t i = 0; i < view_.fluid_count; ++i) place[particles_.id[i]] = i;
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a over 64-bit words, with a fold against its weak low bits
    for (const std::uint32_t i : place) {
      if (i == none) continue;
      each_scalar(view_.u.load(i), [&](const auto& a, int) {
        std::uint64_t word = 0;
        __builtin_memcpy(&word, &a, sizeof a);
        hash = (hash ^ word) * 0x100000001b3u;
        hash ^= hash >> 29;
      });
    }
    return hash;
  }

  particle_table snapshot() const override { return to_table(particles_, rows_); }
  std::size_t lost() const override { return lost_; }
  std::size_t fluid_count() const override { return index_.fluid(); }

  typename base::dynamics rates_of_state() override {
    typename base::dynamics found;
    if constexpr (requires(rates_of<I> r) {
                    r.drho;
                    r.dv;
                  }) {
      static_assert(field_count<rates_of<I>> == 1 + D, "drho, then dv");
      const auto u = columns_.rates();
      found.drho = u.template column_as<R>(0);
      for (int d = 0; d < D; ++d) found.dv[d] = u.template column_as<R>(1 + d);
    }
    return found;
  }

 private:
  setup setup_;
  indexer<D, R> index_;
  interaction_columns<I> columns_;
  typename B::template workspace<I> workspace_;
  problem<I> view_{};
  std::size_t rows_ = 0, lost_ = 0;
};

}  // namespace pairsum
