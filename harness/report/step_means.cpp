#include "harness/report/step_means.hpp"

#include "harness/rows/add_thread_times.hpp"

namespace pairsum::harness {
namespace {

thread_times divided(thread_times t, std::size_t by) {
  for (auto& pass : t)
    for (double& s : pass) s /= static_cast<double>(by);
  return t;
}

}  // namespace

phases mean_of(const std::vector<phases>& all) {
  phases mean;
  for (const phase_member& phase : phase_members) {
    double sum = 0;
    std::size_t timed = 0;
    for (const phases& p : all) {
      sum += (p.*phase.value).value_or(0);
      timed += (p.*phase.value).has_value();
    }
    if (timed == all.size()) mean.*phase.value = sum / static_cast<double>(timed);
  }
  return mean;
}

void step_means::count_sum::add(const std::optional<std::uint64_t>& more) {
  if (!more) return;
  sum += *more;
  ++rows;
}

std::optional<std::uint64_t> step_means::count_sum::mean() const {
  return rows > 0 ? std::optional(sum / rows) : std::nullopt;
}

void step_means::add(const sample& s) {
  if (s.threads_busy_s && s.barrier_wait_s && !s.threads_busy_s->empty()) {
    add_to(busy_, *s.threads_busy_s);
    add_to(waiting_, *s.barrier_wait_s);
    ++timed_;
  }
  if (!s.counters) return;
  cycles_.add(s.counters->cycles);
  instructions_.add(s.counters->instructions);
  misses_.add(s.counters->cache_misses);
}

void step_means::put(measured_point& p) const {
  if (timed_ > 0) {
    p.busy_s = divided(busy_, timed_);
    p.waiting_s = divided(waiting_, timed_);
  }
  if (cycles_.rows + instructions_.rows + misses_.rows > 0)
    p.counters = counters_row{cycles_.mean(), instructions_.mean(), misses_.mean()};
}

}  // namespace pairsum::harness
