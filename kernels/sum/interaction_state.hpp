#pragma once
#include <cstring>

#include "sum/check.hpp"
#include "sum/omega.hpp"
#include "sum/problem.hpp"
#include "sum/rate_names.hpp"
#include "sum/state.hpp"

namespace pairsum {

/// Columns of one interaction for one set of particles, and the problem that points to them.
template <interaction I>
class interaction_columns {
  using R = typename I::real;
  static constexpr int D = I::dim;

 public:
  explicit interaction_columns(const physics& constants, const torus<D, R>& omega = {})
      : formula_(constants), H_(static_cast<R>(constants.H)), omega_(omega) {}

  /// Derives the per-particle terms of boundary [fluid, fluid + boundary) and, unless the backend does, of fluid [0,
  /// fluid).
  [[gnu::noinline]] void derive(const particle_set<D, R>& p, std::size_t fluid, std::size_t boundary, const team& t,
                                bool with_fluid = true) {
    fluid_.resize(fluid);
    boundary_.resize(boundary);
    u_.resize(fluid);
    const auto to = fluid_.pointers();
    if (with_fluid)
      t.for_pieces(fluid, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) to.store(i, formula_.derive(state_of(p, i)));
      });
    if constexpr (has_boundary<I>) {
      const auto wall = boundary_.pointers();
      t.for_pieces(boundary, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) wall.store(i, formula_.derive_boundary(state_of(p, fluid + i)));
      });
    }
  }

  [[gnu::noinline]] void zero_rates(const team& t) {
    const auto u = u_.pointers();
    t.for_pieces(u_.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) u.store(i, zero<rates_of<I>>());
    });
  }

  field_pointers<rates_of<I>> rates() { return u_.pointers(); }

  problem<I> view(const particle_set<D, R>& p, const cells<D>& c) {
    problem<I> v{};
    for (int d = 0; d < D; ++d) v.x.column[d] = p.x[d].data();
    v.x.omega = omega_;
    v.fluid = fluid_.pointers();
    v.boundary = boundary_.pointers();
    v.u = u_.pointers();
    v.grid_cells = &c;
    v.formula = &formula_;
    const R reach = static_cast<R>(boundary_reach<I>()) * H_;
    v.reach2 = H_ * H_;
    v.boundary_reach2 = reach * reach;
    v.fluid_count = fluid_.size();
    v.count = fluid_.size() + boundary_.size();
    v.particles = &p;
    return v;
  }

 private:
  static particle_state<D, R> state_of(const particle_set<D, R>& p, std::size_t i) {
    return {p.position(i), p.velocity(i), p.rho[i], p.m[i], p.id[i]};
  }

  I formula_;
  R H_;
  torus<D, R> omega_;
  field_columns<particle_of<I>> fluid_;
  field_columns<boundary_particle_of<I>> boundary_;
  field_columns<rates_of<I>> u_;
};

/// A summation whose interaction is known: all that does not depend on the backend.
template <interaction I>
class interaction_state : public state<I::dim, typename I::real> {
  using R = typename I::real;
  static constexpr int D = I::dim;
  using base = state<D, R>;

 public:
  void check(const particle_table& p) const override {
    base::check(p);
    if constexpr (boundary_is_singular<I>()) check_apart<R>(p, I::name, this->setup_);
  }

  using summation::load;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) override {
    base::load(p, order, t);
    view_ = {};
  }

  rate_table rates() const override {
    rate_table table;
    table.names = rate_names<I>();
    table.columns.assign(field_count<rates_of<I>>, std::vector<double>(this->rows_, 0.0));
    for (std::size_t i = 0; i < view_.fluid_count; ++i)
      each_scalar(view_.u.load(i), [&](const auto& a, int slot) {
        table.columns[slot][this->particles_.id[i]] = static_cast<double>(a);
      });
    return table;
  }

  std::uint64_t fingerprint() const override {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> place(this->rows_, none);
    for (std::uint32_t i = 0; i < view_.fluid_count; ++i) place[this->particles_.id[i]] = i;
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a over 64-bit words, with a fold against its weak low bits
    for (const std::uint32_t i : place) {
      if (i == none) continue;
      each_scalar(view_.u.load(i), [&](const auto& a, int) {
        std::uint64_t word = 0;
        std::memcpy(&word, &a, sizeof a);
        hash = (hash ^ word) * 0x100000001b3u;
        hash ^= hash >> 29;
      });
    }
    return hash;
  }

  typename base::dynamics rates_of_state() override {
    typename base::dynamics found;
    if constexpr (requires(rates_of<I> r) {
                    r.drho;
                    r.dv;
                  }) {
      const auto u = columns_.rates();
      found.drho = u.template column_as<R>(field_slot(&rates_of<I>::drho));
      for (int d = 0; d < D; ++d) found.dv[d] = u.template column_as<R>(field_slot(&rates_of<I>::dv) + d);
    }
    return found;
  }

 protected:
  // Not inline: each backend would compile its own copies.
  interaction_state(const setup& s, double skin);
  ~interaction_state() override;

  /// Derives what the formula needs of the particles as indexed last.
  [[gnu::noinline]] const problem<I>& derive(const team& t, bool with_fluid) {
    columns_.derive(this->particles_, this->index_.fluid(), this->index_.boundary(), t, with_fluid);
    return view_ = columns_.view(this->particles_, this->index_.view());
  }

  interaction_columns<I> columns_;
  problem<I> view_{};
};

template <interaction I>
interaction_state<I>::interaction_state(const setup& s, double skin)
    : base(s, skin), columns_(s.constants, make_torus<D, R>(s, skin)) {}
template <interaction I>
interaction_state<I>::~interaction_state() = default;

}  // namespace pairsum
