#include "harness/measure/worker_team.hpp"

#include <omp.h>
#include <tbb/task_scheduler_observer.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <pairsum/core/error.hpp>
#include <pairsum/core/omp_loop.hpp>
#include <pairsum/core/tbb_arena.hpp>
#include "harness/measure/binding.hpp"

namespace pairsum::harness {

/// Binds each thread that enters an arena to the unit of its slot.
class worker_team::slot_binder : public ::tbb::task_scheduler_observer {
 public:
  slot_binder(::tbb::task_arena& arena, const thread_binding& binding, int first)
      : task_scheduler_observer(arena), binding_(binding), first_(first) {
    observe(true);
  }
  ~slot_binder() override { observe(false); }

  void on_scheduler_entry(bool) override {
    binding_.bind_this_thread(first_ + ::tbb::this_task_arena::current_thread_index());
  }
  void on_scheduler_exit(bool is_worker) override {
    if (is_worker) binding_.release_this_thread();  // the caller stays where it is between two phases
  }

 private:
  const thread_binding& binding_;
  int first_;
};

int untimed_threads(int cores) { return std::min(cores, omp_get_thread_limit()); }

worker_team::worker_team(runtime kind, int threads, const thread_binding* binding, int first) : binding_(binding) {
  if (kind == runtime::omp) {
    team_ = team::omp(threads);
    omp_region(threads, [&](int thread) {
      if (binding_) binding_->bind_this_thread(first + thread);
    });
    return;
  }
  omp_pause_resource_all(omp_pause_hard);
  if (kind == runtime::tbb) {
    arena_ = std::make_unique<tbb_arena>(threads);
    team_ = team::tbb(threads, *arena_);
    if (binding_) binder_ = std::make_unique<slot_binder>(arena_->arena, *binding_, first);
  }
  if (binding_) binding_->bind_this_thread(first);
  if (kind != runtime::tbb) return;
  if (const int got = threads_at_once(team_, std::chrono::seconds(10)); got != threads)
    throw error("oneTBB gave " + std::to_string(got) + " of " + std::to_string(threads) +
                " threads: something else holds its workers");
}

int threads_at_once(const team& t, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::atomic<int> inside = 0, most = 0;
  t.for_each(static_cast<std::size_t>(t.threads()), [&](std::size_t) {
    const int now = ++inside;
    for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
    }
    while (most < t.threads() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    --inside;
  });
  return most;
}

worker_team::~worker_team() {
  if (!binding_) return;
  if (team_.kind() == runtime::omp) {
#pragma omp parallel num_threads(team_.threads())
    binding_->release_this_thread();
  }
  binding_->release_this_thread();
}

}  // namespace pairsum::harness
