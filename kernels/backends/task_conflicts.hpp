#pragma once
// Tasks that exclude each other where they conflict, on oneTBB's flow graph. In 2D, four blocks that meet in a point:
//
//   +-------+-------+         tasks = blocks of cells; colour: the first that is free
//   |   2   |   3   |         two tasks conflict if they write to a common cell (their own, or a forward neighbour)
//   |       |       |         conflict (a, b):  edge from the lower (colour, number) to the higher
//   +-------+-------+
//   |   0   |   1   |         0 --> 1 --> 2 --> 3     each task, as soon as those with an edge to it are done:
//   |       |       |          \__________\___/         for cell in block, for i in cell:
//   +-------+-------+                                     for j > i in cell, j in forward cells:
//                                                           u_i += f(i,j), u_j += f(j,i)
//
// Race-free: of two tasks that write to a common cell one waits for the other. Edges ascend, so there is no cycle and
// no task waits for ever; no path is longer than there are colours, and nobody waits for a whole pass. The order in
// which blocks add to a particle is that of the edges, whoever runs them: bit-identical for every number of threads.
#include <memory>

#include "core/tbb_arena.hpp"
#include "core/tbb_graph.hpp"
#include "sum/backend.hpp"
#include "sum/block_conflicts.hpp"
#include "sum/block_setup.hpp"
#include "sum/scatter_cell.hpp"

namespace pairsum {

struct task_conflicts {
  static constexpr backend_traits traits{
      .name = "task_conflicts",
      .description = "half-stencil sweep, blocks of cells as tasks that wait where they conflict, with oneTBB",
      .aliases = "tasks with conflicts (SWIFT), task graph, dependency colouring, Newton-3",
      .threads = runtime::tbb,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::simple, 1},  // a task at a time, whatever the team says
      .blocks = true,
      .colours = {1, 1, 1},
      .conflicts = conflict_avoidance::tasks};

  template <class I>
  struct workspace {
    cell_blocks<I::dim> blocks;
    std::unique_ptr<tbb_graph> graph;

    /// Throws pairsum::error for a block that is not to be had.
    void configure(const setup& s) { shape_blocks(blocks, s, column_bytes_per_cell<I>(), true); }

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      if (!blocks.build(p.cells()) && graph) return;
      graph.reset();
      const std::vector<block_pair> conflicts = conflicts_of(p.cells(), blocks);
      const std::vector<unsigned> colour = colours_for(blocks.size(0), conflicts);
      std::vector<task_order> order;
      order.reserve(conflicts.size());
      for (const auto& [a, b] : conflicts) order.push_back(colour[a] < colour[b] ? task_order{a, b} : task_order{b, a});
      t.arena().arena.execute([&] { graph = std::make_unique<tbb_graph>(blocks.size(0), order); });
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      t.arena().arena.execute([&] {
        probe.pass_begins(0);
        graph->run([&](std::size_t k) {
          const int thread = ::tbb::this_task_arena::current_thread_index();
          probe.work_begins(0, thread);
          mark_unit(probe, 0, k);
          for (const std::uint32_t cell : blocks(0, k)) scatter_cell_in_order(p, cell, probe);
          probe.work_ends(0, thread);
        });
        probe.pass_ends(0);
      });
    }

    std::string block() const { return blocks.shape().word(); }
  };
};

}  // namespace pairsum
