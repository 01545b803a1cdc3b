// Mistakes that schedules could contain; each must be reported, or silence about the library proves nothing.
#include "planted.hpp"

#include <pairsum/schedule/block.hpp>
#include <pairsum/schedule/locked_slabs.hpp>

namespace pairsum::races {
namespace {

constexpr backend_traits racy{
    .description = "a backend with a race", .deterministic = false, .loop = {loop_schedule::dynamic, 32}};

/// No barrier after a pass: a thread starts the next colour while others still write its cells.
template <int D, class R>
class nowait final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits = racy;

  void prepare(const P& p, const team& t) override { blocks_.build(p.cells(), t); }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return blocks_[colour].size(); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    sum_block_of(p, blocks_[colour], k, p.to(thread));
  }
  void sum(const P& p, const team& t, const backend_traits&, const pass_marks&) override {
    omp_region(t.threads(), [&](int thread) {
      for (unsigned o = 0; o < colours(p); ++o) {
        const std::size_t n = size(p, o);
#pragma omp for schedule(dynamic, 32) nowait
        for (std::size_t k = 0; k < n; ++k) unit(p, o, k, thread);
      }
    });
  }

 private:
  coloured_blocks<D> blocks_;
};

/// All colours in one pass: blocks that share a cell run side by side.
template <int D, class R>
class one_colour final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits = racy;

  void prepare(const P& p, const team& t) override {
    coloured_blocks<D> coloured;
    coloured.build(p.cells(), t);
    blocks_.clear();
    for (unsigned o = 0; o < coloured.colours(); ++o)
      blocks_.insert(blocks_.end(), coloured[o].begin(), coloured[o].end());
  }
  std::size_t size(const P&, unsigned) const override { return blocks_.size(); }
  void unit(const P& p, unsigned, std::size_t k, int thread) override { sum_block_of(p, blocks_, k, p.to(thread)); }

 private:
  column<block<D>> blocks_;
};

/// Nothing is locked where two slabs meet.
struct no_locks {
  struct guard {
    template <class Wait>
    guard(no_locks&, std::int32_t, std::int32_t, Wait&&) {}
    ~guard() {}
  };
  void resize(std::size_t) {}
};
template <int D, class R>
using without_locks = slabs_with<D, R, no_locks>;

}  // namespace

std::vector<backend_entry> planted_backends() {
  return {backend_entry::of<nowait>("nowait", runtime::omp), backend_entry::of<one_colour>("one_colour", runtime::omp),
          backend_entry::of<without_locks>("without_locks", runtime::omp),
          backend_entry::of<one_colour>("one_colour_tbb", runtime::tbb)};
}

}  // namespace pairsum::races
