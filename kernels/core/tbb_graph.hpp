#pragma once
#include <tbb/flow_graph.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <pairsum/core/team.hpp>

namespace pairsum {

/// Task `after` begins when task `before` has ended.
struct task_order {
  std::uint32_t before, after;
  bool operator==(const task_order&) const = default;
  auto operator<=>(const task_order&) const = default;
};

/// Tasks in a partial order, on oneTBB; made once, run many times.
class tbb_graph {
 public:
  /// The order must have no cycle.
  tbb_graph(std::size_t tasks, std::span<const task_order> order) {
    std::vector<bool> waits(tasks, false);
    for (std::size_t k = 0; k < tasks; ++k) nodes_.emplace_back(graph_, [this, k](const message&) { (*task_)(k); });
    for (const auto& [before, after] : order) {
      ::tbb::flow::make_edge(nodes_[before], nodes_[after]);
      waits[after] = true;
    }
    for (std::uint32_t k = 0; k < tasks; ++k)
      if (!waits[k]) roots_.push_back(k);
  }
  tbb_graph(const tbb_graph&) = delete;
  tbb_graph& operator=(const tbb_graph&) = delete;

  /// Calls f(k) for every task k, on the threads of the arena that the caller is in; returns when all are done. If one
  /// throws, those that have not begun are left out, and the exception comes out here; the graph can be run again.
  void run(index_function f) {
    task_ = &f;
    graph_.reset();  // to the caller's arena, and without what an exception left behind
    for (const std::uint32_t k : roots_) nodes_[k].try_put(message());
    graph_.wait_for_all();
  }

 private:
  using message = ::tbb::flow::continue_msg;

  const index_function* task_ = nullptr;
  std::vector<std::uint32_t> roots_;
  ::tbb::flow::graph graph_;
  std::deque<::tbb::flow::continue_node<message>> nodes_;
};

}  // namespace pairsum
