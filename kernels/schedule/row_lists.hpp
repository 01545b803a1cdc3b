#pragma once
// The list of Liu & Liu made parallel: found by all threads, swept in coloured blocks of cells:
//
//   prepare:  parallel for fluid cells:  list = interacting pairs (i, j) by rows i, each once, found through the cells
//   sum:      for each colour:                       4 in 3D (pencils), 2 in 2D and 1D (slabs); a barrier after each
//               parallel for blocks of the colour:
//                 for cell in block, for i in cell, for j in row i:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//     |## |   |## |   |         blocks ## of a colour; their partners j lie in them or in a cell beside
//
// Race-free: a row's partners lie in the cell of i or in its neighbours, and blocks of a colour are at least two cells
// apart (schedule/cell_blocks.hpp). Bit-identical for every number of threads: neither rows nor blocks depend on it.
//
// The serial one goes row after row, as the list of Liu & Liu ("Smoothed Particle Hydrodynamics", World Scientific
// 2003, ch. 4) does; all partners of i follow each other, so i is stored once.
#include <pairsum/schedule/block_setup.hpp>
#include <pairsum/schedule/pair_rows.hpp>
#include <pairsum/sum/schedule.hpp>

namespace pairsum {

/// Listed rows in coloured blocks of cells: a row's partners lie in the cell of its particle or in a neighbour, and
/// blocks of a colour are at least two cells apart.
template <int D, class R>
class row_blocks : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  /// `tested`: the list also holds pairs beyond the cutoff.
  explicit row_blocks(bool tested) : tested_(tested) {}

  void configure(const setup& s, std::size_t cell_bytes) override { shape_blocks(blocks_, s, cell_bytes); }
  std::string block() const override { return blocks_.shape().word(); }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return blocks_.size(colour); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    index_range rows{0, 0};  // of cells whose particles follow each other
    const auto sum = [&] { sum_listed(p, p.to(thread), rows_.data() + rows.begin, rows.size(), tested_); };
    for (const std::uint32_t cell : blocks_(colour, k)) {
      const index_range& own = p.cells().range[cell].fluid;
      if (own.begin != rows.end) {
        if (!rows.empty()) sum();
        rows.begin = own.begin;
      }
      rows.end = own.end;
    }
    if (!rows.empty()) sum();
  }

 protected:
  pair_rows<D, R> rows_;
  cell_blocks<D> blocks_;

 private:
  bool tested_;
};

template <int D, class R>
class row_lists final : public row_blocks<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "Liu & Liu's list of interacting pairs, found and swept in parallel: coloured blocks",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .keeps_pairs = true,
      .loop = {loop_schedule::dynamic, 1},
      .blocks = true};

  row_lists() : row_blocks<D, R>(false) {}
  void prepare(const P& p, const team& t) override {
    this->rows_.build(p, p, t, p.counts);
    this->blocks_.build(p.cells());
  }
};

/// The same on one thread.
template <int D, class R>
class row_after_row final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "Liu & Liu: list of interacting pairs (prepare), then one symmetric sweep (sum)",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .keeps_pairs = true};

  void prepare(const P& p, const team& t) override { rows_.build(p, p, t, p.counts); }
  std::size_t size(const P&, unsigned) const override { return 1; }
  void unit(const P& p, unsigned, std::size_t, int thread) override {
    sum_listed(p, p.to(thread), rows_.data(), p.fluid_count, false);
  }

 private:
  pair_rows<D, R> rows_;
};

}  // namespace pairsum
