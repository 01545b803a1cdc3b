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
// no deadlock; no path is longer than the number of colours, and no task waits for a whole pass. The order in
// which blocks add to a particle is that of the edges, on any thread: bit-identical for every number of threads.
#include <memory>
#include <pairsum/core/tbb_arena.hpp>
#include <pairsum/core/tbb_graph.hpp>
#include <pairsum/schedule/block_conflicts.hpp>
#include <pairsum/schedule/block_setup.hpp>
#include <pairsum/schedule/cell_sweep.hpp>

namespace pairsum {

template <int D, class R>
class conflicting_tasks final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "half-stencil sweep, blocks of cells as tasks that wait where they conflict",
      .aliases = "tasks with conflicts (SWIFT), task graph, dependency colouring, Newton-3",
      .loop = {loop_schedule::simple, 1},  // a task at a time, whatever the team says
      .blocks = true,
      .conflicts = conflict_avoidance::tasks};

  void configure(const setup& s, std::size_t cell_bytes) override { shape_blocks(blocks_, s, cell_bytes, true); }
  std::string block() const override { return blocks_.shape().word(); }

  void prepare(const P& p, const team& t) override {
    if (!blocks_.build(p.cells()) && graph_) return;
    graph_.reset();
    const std::vector<block_pair> conflicts = conflicts_of(p.cells(), blocks_);
    const std::vector<unsigned> colour = colours_for(blocks_.size(0), conflicts);
    std::vector<task_order> order;
    order.reserve(conflicts.size());
    for (const auto& [a, b] : conflicts) order.push_back(colour[a] < colour[b] ? task_order{a, b} : task_order{b, a});
    t.arena().arena.execute([&] { graph_ = std::make_unique<tbb_graph>(blocks_.size(0), order); });
  }

  std::size_t size(const P&, unsigned) const override { return blocks_.size(0); }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    for (const std::uint32_t cell : blocks_(0, k)) sweep_cell_in_order(p, cell, p.to(thread));
  }
  void sum(const P& p, const team& t, const backend_traits&, const pass_marks& marks) override {
    t.arena().arena.execute([&] {
      marks.pass_begins(0);
      graph_->run([&](std::size_t k) {
        const int thread = ::tbb::this_task_arena::current_thread_index();
        marks.work_begins(0, thread);
        marks.unit_begins(0, k);
        unit(p, 0, k, thread);
        marks.work_ends(0, thread);
      });
      marks.pass_ends(0);
    });
  }

 private:
  cell_blocks<D> blocks_;
  std::unique_ptr<tbb_graph> graph_;
};

}  // namespace pairsum

PAIRSUM_BACKEND(task_conflicts, conflicting_tasks, tbb)
