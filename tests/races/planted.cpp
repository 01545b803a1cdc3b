// Mistakes that symmetric_omp and sliced_locks could contain; each must be reported, or silence about the library
// proves nothing.
#include "backends/sliced_locks.hpp"
#include "contender.hpp"
#include "sum/backend.hpp"
#include "sum/block.hpp"

namespace pairsum::races {
namespace {

constexpr backend_traits traits_of_planted(std::string_view name) {
  return {.name = name,
          .description = "a backend with a race",
          .aliases = "",
          .threads = runtime::omp,
          .symmetric = true,
          .deterministic = false,
          .accumulates = true,
          .evaluations_per_pair = 1,
          .sweeps_per_colour = true,
          .keeps_pairs = false};
}

/// No barrier after a pass: a thread starts the next colour while others still write its cells.
struct nowait {
  static constexpr backend_traits traits = traits_of_planted("nowait");

  template <class I>
  struct workspace {
    coloured_blocks<I::dim> blocks;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      blocks.build(p.cells(), t);
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
#pragma omp parallel num_threads(t.threads())
      for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o) {
        const auto* const b = blocks[o].data();
        const std::size_t n = blocks[o].size();
#pragma omp for schedule(dynamic, 32) nowait
        for (std::size_t k = 0; k < n; ++k) sum_block(p, b[k], probe);
      }
    }
  };
};

/// All colours in one pass: blocks that share a cell run side by side.
struct one_colour {
  static constexpr backend_traits traits = traits_of_planted("one_colour");

  template <class I>
  struct workspace {
    column<block<I::dim>> blocks;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      coloured_blocks<I::dim> coloured;
      coloured.build(p.cells(), t);
      blocks.clear();
      for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o)
        blocks.insert(blocks.end(), coloured[o].begin(), coloured[o].end());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const auto* const b = blocks.data();
      const std::size_t n = blocks.size();
#pragma omp parallel for num_threads(t.threads()) schedule(dynamic, 32)
      for (std::size_t k = 0; k < n; ++k) sum_block(p, b[k], probe);
    }
  };
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
struct without_locks {
  static constexpr backend_traits traits = traits_of_planted("without_locks");

  template <class I>
  struct workspace : sliced_workspace<I, no_locks> {
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      sliced_workspace<I, no_locks>::sum(p, t, sliced_locks::traits.loop, probe);
    }
  };
};

}  // namespace

const std::vector<contender>& planted_backends() {
  static const std::vector<contender> all{contender::of<nowait>(), contender::of<one_colour>(),
                                          contender::of<without_locks>()};
  return all;
}

}  // namespace pairsum::races
