#pragma once
// The talk's passes (Willkomm 2009; Willkomm & Buecker 2011):
//
//   for o in {0,1}^d:                                    2^d passes, a barrier after each
//     parallel for base cells B = 2i + o:
//       sumF1(B)
//       for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//
// Race-free: a block touches its 2^d cells B + {0,1}^d alone. Base cells of a pass have equal parity o, so on a grid of
// even side (2^M, the torus included) two blocks of a pass share no cell; passes are separated by barriers. Around an
// axis of 3 cells each coordinate is a colour of its own (pattern/axis_colours.hpp): 3 passes in place of 2. For the
// same reason the order in which a particle's rate is added to does not depend on the threads: the result is
// bit-identical.
//
// In 2D, o = (0,0), the blocks of a pass:
//
//   +---+---+---+---+
//   | x   x | x   x |
//   +  \ /  +  \ /  +     Only blocks that hold fluid are listed.
//   | B - x | B - x |
//   +---+---+---+---+
#include <pairsum/schedule/block.hpp>

namespace pairsum {

template <int D, class R>
class base_blocks final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{.description = "the talk's 2^d conflict-free passes over base blocks",
                                         .aliases = "Newton-3, c08 (eight colours in 3D)",
                                         .sweeps_per_colour = true,
                                         .loop = {loop_schedule::dynamic, 32},
                                         .colours = {2, 4, 8}};

  void prepare(const P& p, const team& t) override { blocks_.build(p.cells(), t); }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return blocks_[colour].size(); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    sum_block_of(p, blocks_[colour], k, p.to(thread));
  }

 private:
  coloured_blocks<D> blocks_;
};

}  // namespace pairsum
