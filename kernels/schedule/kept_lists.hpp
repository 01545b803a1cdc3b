#pragma once
// A list of pairs with a skin s, kept from step to step (Verlet, Phys. Rev. 159 (1967) 98):
//
//   index, prepare:  if a particle has moved by more than s/2 since the list was made, or there is none:
//                      sort the particles into cells of width H + s;  list = pairs nearer than H + s, each once
//   sum:             for each colour, parallel for blocks of the colour:    as in row_lists.hpp
//                      for i in block, for j in row i with |x_i - x_j| < H:
//                        c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//        H + s  : listed        two particles that are not listed were H + s apart, and each has come closer by s/2
//        (  H  )  : summed      at most: they are still beyond the cutoff
//
// While the list is valid particles keep their order, so nothing is sorted. Race-free and bit-identical for every
// number of threads, as row_lists.hpp says: rows and blocks are those of the cells the list was made from.
#include <cmath>

#include <pairsum/schedule/displacement.hpp>
#include <pairsum/schedule/row_lists.hpp>

namespace pairsum {

template <int D, class R>
class kept_lists final : public row_blocks<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "list of pairs with a skin of 0.1 H, kept until a particle has moved half of it",
      .aliases = "Verlet list, half neighbour list with skin (LAMMPS, AutoPas), Newton-3",
      .loop = {loop_schedule::dynamic, 1},
      .blocks = true,
      .skin = 0.1};

  kept_lists() : row_blocks<D, R>(true) {}
  bool outlasts(const P& p, const team& t) const override {
    if (!serves_) return false;
    // 2 % of the half are for rounding, and what a difference through the faces of a periodic box is rounded by.
    const R limit = R(0.49 * traits.skin) * cutoff(p) - 2 * p.x.omega.rounding();
    return limit > 0 && moved_.at_most(limit, p.x, p.fluid_count, t);
  }
  void expire() override { serves_ = false; }
  /// How many lists were made.
  std::size_t lists_made() const { return lists_made_; }

  void prepare(const P& p, const team& t) override {
    if (serves_) return;
    const R skin = R(traits.skin) * cutoff(p), far = cutoff(p) + skin, boundary = std::sqrt(p.boundary_reach2) + skin;
    search_space<D, R> space = p;
    space.reach2 = far * far;
    space.boundary_reach2 = p.boundary_reach2 > 0 ? boundary * boundary : R(0);
    work_counts listing;  // of which the cells alone count: the tests are those of a sum, which makes no list as a rule
    this->rows_.build(p, space, t, p.counts != nullptr ? &listing : nullptr);
    if (p.counts != nullptr) {
      p.counts->sumF1 += listing.sumF1;
      p.counts->sumF2 += listing.sumF2;
    }
    this->blocks_.build(p.cells());
    moved_.since(p.x, p.fluid_count, t);
    serves_ = true;
    ++lists_made_;
  }

 private:
  static R cutoff(const P& p) { return std::sqrt(p.reach2); }

  displacement<D, R> moved_;
  bool serves_ = false;
  std::size_t lists_made_ = 0;
};

}  // namespace pairsum
