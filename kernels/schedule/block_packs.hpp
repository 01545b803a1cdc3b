#pragma once
// The talk's base blocks in plus-shaped packs, which need only 4 colours and barriers:
//
//   for each colour:                                      4 in 3D, 3 in 2D, 2 in 1D; a barrier after each
//     parallel for packs of the colour:
//       for base cells B of the pack:
//         sumF1(B)
//         for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//
//     . A A . . a a .        2D: packs A and a of two colours, a chessboard, and the squares between them (.), which
//     A A A A a a a a        are packs of the third
//     A A A A a a a a
//     . A A . . a a .
//
// Race-free: a pack touches its cells and one more ahead along each axis, and packs of a colour are so far apart, and
// so shaped, that these sets do not meet (schedule/coloured_packs.hpp, where it is also checked while colours are
// given). Bit-identical for every number of threads: neither packs nor their colours depend on it.
#include <pairsum/schedule/coloured_packs.hpp>

#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R>
class block_packs final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{.description = "base blocks in plus-shaped packs, 4 colours in 3D",
                                         .aliases = "Newton-3, c04 (AutoPas)",
                                         .sweeps_per_colour = true,
                                         .loop = {loop_schedule::dynamic, 2},
                                         .colours = {2, 3, 4}};

  void prepare(const P& p, const team&) override { packs_.build(p.cells()); }
  unsigned colours(const P&) const override { return packs_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return packs_.size(colour); }
  void unit(const P& p, unsigned colour, std::size_t pack, int thread) override {
    const auto [begin, end] = packs_(colour, pack);
    for (std::size_t k = begin; k < end; ++k) sum_block_of(p, packs_.blocks(), k, p.to(thread));
  }

 private:
  coloured_packs<D> packs_;
};

}  // namespace pairsum
