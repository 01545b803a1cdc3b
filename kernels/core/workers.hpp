#pragma once
#include <memory>

#include <pairsum/core/team.hpp>

namespace pairsum {

/// Owns the threads of a team, for callers without threads of their own. Keep it while its team works.
class workers {
 public:
  /// `threads` threads of that kind, at least 1 (else pairsum::error); serial backends index with OpenMP threads and
  /// sum on one.
  workers(runtime kind, int threads);
  ~workers();

  const team& get() const { return team_; }

 private:
  std::unique_ptr<tbb_arena> arena_;
  team team_;
};

}  // namespace pairsum
