// The backend "reverse_passes": the talk's passes from the last colour to the first and from the last block to the
// first. It sums every formula of the program, those of plug-ins among them:
//
//   for each parity o in {0,1}^d, the last first:        2^d passes, a barrier after each
//     parallel for base cells B = 2i + o:
//       all pairs in the block B + {0,1}^d that the pattern gives to it
//
// Race-free: blocks of a pass share no cell (pairsum/schedule/base_blocks.hpp). A particle's rate is added to in an
// order that no thread decides, so the result is bit-identical for every number of threads.
#include <pairsum/schedule/block.hpp>

namespace pairsum {

template <int D, class R> class reverse_blocks final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{.description = "example: the talk's passes, the last block first",
                                         .aliases = "c08, backwards",
                                         .sweeps_per_colour = true,
                                         .loop = {loop_schedule::dynamic, 32},
                                         .colours = {2, 4, 8}};

  void prepare(const P& p, const team& t) override { blocks_.build(p.cells(), t); }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned pass) const override { return blocks_of(pass).size(); }
  void unit(const P& p, unsigned pass, std::size_t k, int thread) override {
    const auto& blocks = blocks_of(pass);
    sum_block(p, blocks[blocks.size() - 1 - k], p.to(thread));
  }

 private:
  const column<block<D>>& blocks_of(unsigned pass) const { return blocks_[blocks_.colours() - 1 - pass]; }

  coloured_blocks<D> blocks_;
};

}  // namespace pairsum

PAIRSUM_BACKEND(reverse_passes, reverse_blocks, omp)
