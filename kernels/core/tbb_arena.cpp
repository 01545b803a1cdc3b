#include <pairsum/core/tbb_arena.hpp>

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include <pairsum/core/error.hpp>

namespace pairsum {
namespace {

using ::tbb::global_control;

struct all_allowances {
  std::mutex one_at_a_time;
  std::multiset<int> threads;
  std::unique_ptr<global_control> control;  ///< the one for all of them
  std::size_t most = 0;

  void renew() {
    const std::size_t wanted = threads.empty() ? 0
                                               : std::max(static_cast<std::size_t>(*threads.rbegin()),
                                                          std::size_t{std::thread::hardware_concurrency()});
    if (wanted == most) return;
    most = wanted;
    control = wanted == 0 ? nullptr : std::make_unique<global_control>(global_control::max_allowed_parallelism, wanted);
  }
};

all_allowances& allowances() {
  static auto& all = *new all_allowances;  // arenas of static life may end after it
  return all;
}

}  // namespace

tbb_allowance::tbb_allowance(int threads) : threads_(threads) {
  all_allowances& all = allowances();
  const std::lock_guard lock(all.one_at_a_time);
  all.threads.insert(threads_);
  all.renew();
}

tbb_allowance::~tbb_allowance() {
  all_allowances& all = allowances();
  const std::lock_guard lock(all.one_at_a_time);
  all.threads.erase(all.threads.find(threads_));
  all.renew();
}

void check_arena(int threads) {
  const std::size_t most = global_control::active_value(global_control::max_allowed_parallelism);
  if (most < static_cast<std::size_t>(threads))
    throw error("oneTBB gives " + std::to_string(most) + " of " + std::to_string(threads) +
                " threads; end or raise the tbb::global_control that limits max_allowed_parallelism");
}

}  // namespace pairsum
