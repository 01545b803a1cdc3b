#pragma once
#include <memory>

#include "interactions/count.hpp"
#include "sum/grids.hpp"
#include "sum/interaction_state.hpp"

namespace pairsum {

/// Lets a workspace that wants it read the setup.
template <class W>
void configure(W& workspace, const setup& s) {
  if constexpr (requires { workspace.configure(s); }) workspace.configure(s);
}

/// Counts the work of backend B on indexed particles, by summing `count` on one thread.
template <class B, int D, class R>
work_counts count_work_of(const particle_set<D, R>& p, const indexer<D, R>& index, const setup& s) {
  using I = count<D, R>;
  interaction_columns<I> columns(s.constants, make_torus<D, R>(s, B::traits.skin));
  const team alone;
  columns.derive(p, index.fluid(), index.boundary(), alone);
  columns.zero_rates(alone);
  typename B::template workspace<I> workspace;
  configure(workspace, s);
  work_probe probe;
  with_one_thread(B::traits.threads, [&](const team& one) {
    const auto view = columns.view(p, index.view());
    workspace.prepare(view, one, probe);
    workspace.sum(view, one, probe);
  });
  probe.counts.cells = index.view().total;
  probe.counts.cells_nonempty = index.view().nonempty();
  return probe.counts;
}

/// The adapter between the erased door and one backend with one interaction.
template <class B, interaction I>
requires backend<B, I>
class summation_of final : public interaction_state<I> {
  using base = interaction_state<I>;
  using workspace = typename B::template workspace<I>;
  using base::view_;
  static_assert(B::traits.evaluations_per_pair > 0, "the backend's traits lack evaluations_per_pair");

 public:
  explicit summation_of(const setup& s) : base(s, B::traits.skin) { configure(workspace_, s); }

  const backend_traits& traits() const override { return B::traits; }

  /// For a workspace that keeps lists: nothing, as long as they serve.
  void index(const team& t) override {
    if constexpr (requires { workspace_.outlasts(view_, t); }) {
      const bool same = view_.grid_cells != nullptr && this->index_.holds(this->particles_, t);
      if (same && workspace_.outlasts(view_, t)) return;
      workspace_.expire();
    }
    base::index(t);
  }
  void prepare(const team& t) override {
    no_probe unobserved;
    bool with_fluid = true;
    if constexpr (requires { workspace_.derives_fluid(); }) with_fluid = !workspace_.derives_fluid();
    workspace_.prepare(base::derive(t, with_fluid), t, unobserved);
  }
  void zero(const team& t) override {
    if constexpr (requires { workspace_.zero(view_, t); })
      workspace_.zero(view_, t);
    else if constexpr (B::traits.accumulates)
      this->columns_.zero_rates(t);
  }
  void sum(const team& t) override {
    no_probe marks{this->observer_};
    workspace_.sum(view_, t, marks);
  }
  void reduce(const team& t) override {
    if constexpr (requires { workspace_.reduce(view_, t); }) workspace_.reduce(view_, t);
  }

  std::string block() const override {
    if constexpr (requires { workspace_.block(); })
      return workspace_.block();
    else
      return "none";
  }

  std::size_t lanes() const override {
    if constexpr (requires { workspace_.lanes(); })
      return workspace_.lanes();
    else
      return 1;
  }

  /// The backend's own, for tests.
  const workspace& inner() const { return workspace_; }

  work_counts count_work() override { return count_work_of<B>(this->particles_, this->index_, this->setup_); }

 private:
  workspace workspace_;
};

}  // namespace pairsum
