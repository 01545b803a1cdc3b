#pragma once
#include <vector>

#include <pairsum/core/word_hash.hpp>
#include <pairsum/formula/lanes_of.hpp>
#include <pairsum/formula/mixed.hpp>
#include <pairsum/formula/rate_names.hpp>
#include <pairsum/formula/sum_rows.hpp>
#include <pairsum/sum/check.hpp>
#include <pairsum/sum/formula.hpp>

namespace pairsum {

/// Interaction I as the library sees it.
template <interaction I>
class formula_of final : public formula<I::dim, typename I::real> {
  static constexpr int D = I::dim;
  using R = typename I::real;
  using S = rates_of<I>;
  using rows = sum_rows<I>;

 public:
  explicit formula_of(const setup& s) : formula_(s.constants) {}

  void check(const particle_table& p, const setup& s) const override {
    if constexpr (boundary_is_singular<I>()) check_apart<R>(p, I::name, s);
  }

  void derive(const particle_set<D, R>& p, std::size_t fluid, std::size_t boundary, const team& t,
              bool with_fluid) override {
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
    u_columns_ = u_.pointers();
    view_ = {&formula_, fluid_.pointers(), boundary_.pointers()};
  }

  void open(problem<D, R>& p, R H) override {
    p.formula = &view_;
    p.columns = p.u = {u_columns_.begin.data(), 0};
    p.pairs = &scalar();
    const R reach = static_cast<R>(boundary_reach<I>()) * H;
    p.boundary_reach2 = reach * reach;
  }

  const pair_sum<D, R>& scalar() const override {
    static const std::vector<std::uint16_t> bytes = [] {
      std::vector<std::uint16_t> b;
      each_scalar(zero<S>(), [&](const auto& a, int) { b.push_back(sizeof a); });
      return b;
    }();
    static const pair_sum<D, R> functions = [] {
      pair_sum<D, R> f{};
      if constexpr (!is_mixed<I>) {
        using namespace rows_detail;
        f.both[static_cast<unsigned>(update::plain)] = &rows::template both<to_columns>;
        f.both[static_cast<unsigned>(update::atomic)] = &rows::template both<to_columns_atomically>;
        f.both[static_cast<unsigned>(update::split)] = &rows::template both<to_split_columns>;
        f.own = &rows::own;
        f.fetch = &rows::fetch;
      }
      f.zero = &rows::zero_rates;
      f.add = &rows::add_rates;
      f.rate_bytes = bytes;
      return f;
    }();
    return functions;
  }

  std::span<const lane_sum<D, R>> lanes() const override {
    static const std::vector<lane_sum<D, R>> all = lanes_of<I>();
    return all;
  }
  lane_layout layout() const override { return layout_of<I>(); }

  void fill(const particle_set<D, R>& p, const lane_view<D, R>& to, std::size_t begin, std::size_t end) const override {
    if constexpr (takes_lanes<I>)
      for (std::size_t i = begin; i < end; ++i) fill_row(state_of(p, i), to, i);
  }

  rate_table rates(std::span<const std::uint32_t> id, std::size_t n, std::size_t rows) const override {
    rate_table table;
    table.names = rate_names<I>();
    table.columns.assign(field_count<S>, std::vector<double>(rows, 0.0));
    for (std::size_t i = 0; i < n; ++i)
      each_scalar(u_columns_.load(i),
                  [&](const auto& a, int slot) { table.columns[slot][id[i]] = static_cast<double>(a); });
    return table;
  }

  std::uint64_t fingerprint(std::span<const std::uint32_t> place) const override {
    word_hash hash;
    for (const std::uint32_t i : place) each_scalar(u_columns_.load(i), [&](const auto& a, int) { hash.add(a); });
    return hash.value();
  }

  dynamics<D, R> rates_of_state() const override {
    dynamics<D, R> found;
    if constexpr (requires(S r) {
                    r.drho;
                    r.dv;
                  }) {
      found.drho = u_columns_.template column_as<R>(field_slot(&S::drho));
      for (int d = 0; d < D; ++d) found.dv[d] = u_columns_.template column_as<R>(field_slot(&S::dv) + d);
    }
    return found;
  }

 private:
  static particle_state<D, R> state_of(const particle_set<D, R>& p, std::size_t i) {
    return {p.position(i), p.velocity(i), p.rho[i], p.m[i], p.id[i]};
  }

  void fill_row(const particle_state<D, R>& state, const lane_view<D, R>& to, std::size_t i) const {
    using layout = row_layout<I>;
    using value = pair_real<I>;
    auto* const row = reinterpret_cast<value*>(to.rows + i * layout::bytes);
    for (int d = 0; d < D; ++d) {
      if constexpr (is_mixed<I>)
        row[d] = std::bit_cast<value>(modulo_2_32((state.x[d] - to.origin[d]) / to.mixed_unit[d]));
      else
        row[d] = state.x[d];
    }
    each_scalar(formula_.derive(state), [&](const R& a, int k) { row[D + k] = static_cast<value>(a); });
    std::fill_n(reinterpret_cast<R*>(row + layout::rates_at), layout::rates, R(0));
  }

  I formula_;
  field_columns<particle_of<I>> fluid_;
  field_columns<boundary_particle_of<I>> boundary_;
  field_columns<S> u_;
  field_pointers<S> u_columns_;
  formula_view<I> view_{};
};

}  // namespace pairsum
