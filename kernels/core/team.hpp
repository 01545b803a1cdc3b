#pragma once
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace pairsum {

/// A oneTBB task arena, defined in core/tbb_arena.hpp for the few files that talk to oneTBB.
struct tbb_arena;

/// Which threads do the work.
enum class runtime { serial, omp, tbb };

constexpr std::string_view name_of(runtime r) {
  return r == runtime::serial ? "serial" : r == runtime::omp ? "omp" : "tbb";
}

/// How a parallel loop is distributed: OpenMP's schedules (dynamic, fixed, guided) or oneTBB's partitioners (automatic,
/// simple, fixed).
enum class loop_schedule { none, dynamic, fixed, guided, automatic, simple };

/// A schedule and its chunk (OpenMP) or grain (oneTBB), in iterations.
struct granularity {
  loop_schedule how = loop_schedule::none;
  std::size_t chunk = 0;
  bool operator==(const granularity&) const = default;
};

/// A borrowed callable `void(std::size_t)`; the callee must outlive the call.
class index_function {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, index_function>)
      index_function(F&& f)  // NOLINT: implicit on purpose
      : object_(const_cast<void*>(static_cast<const void*>(&f))),
        call_([](void* o, std::size_t i) { (*static_cast<std::remove_reference_t<F>*>(o))(i); }) {}
  void operator()(std::size_t i) const { call_(object_, i); }

 private:
  void* object_;
  void (*call_)(void*, std::size_t);
};

/// Throws pairsum::error if the system does not give this process `threads` threads (ulimit -u, a container's limit):
/// OpenMP would end the process. Starts and ends as many, once for each larger number.
void check_system(int threads);

/// The threads a call may use, passed in by the caller: a number for OpenMP (`num_threads`), an arena for oneTBB. The
/// library keeps no threads of its own.
class team {
 public:
  /// One thread, the caller's.
  team() = default;
  /// `threads` OpenMP threads; see check_system().
  static team omp(int threads) {
    check_system(threads);
    return team(runtime::omp, threads, nullptr);
  }
  /// The arena's threads; `threads` is its concurrency. The arena must outlive the team.
  static team tbb(int threads, tbb_arena& arena) { return team(runtime::tbb, threads, &arena); }

  runtime kind() const { return kind_; }
  int threads() const { return threads_; }
  tbb_arena& arena() const { return *arena_; }

  /// The same team, but backends share out their loops as `g` says.
  team with(const granularity& g) const {
    team t = *this;
    t.granularity_ = g;
    return t;
  }
  /// What the caller wants, or the backend's own if the caller did not say.
  granularity granularity_or(const granularity& own) const {
    return granularity_.how == loop_schedule::none ? own : granularity_;
  }

  /// Calls f(0) .. f(n-1), each once, on the team's threads; returns when all are done.
  void for_each(std::size_t n, index_function f) const;

  /// Cuts [0, n) into one contiguous piece per thread and calls f(begin, end, piece) for each, pieces in ascending
  /// order of index.
  template <class F>
  void for_pieces(std::size_t n, F&& f) const {
    const std::size_t pieces = static_cast<std::size_t>(threads_);
    for_each(pieces, [&](std::size_t p) { f(n * p / pieces, n * (p + 1) / pieces, p); });
  }

 private:
  team(runtime kind, int threads, tbb_arena* arena) : kind_(kind), threads_(threads), arena_(arena) {}

  runtime kind_ = runtime::serial;
  int threads_ = 1;
  tbb_arena* arena_ = nullptr;
  granularity granularity_;
};

/// Throws pairsum::error if an OpenMP team of `threads` came out as `got`.
void check_team(int threads, int got);

/// Throws pairsum::error if a sum that was prepared for so many threads gets a team of more, or an arena of more, or an
/// arena that oneTBB does not give its threads.
void check_prepared(int threads, const team& t);

}  // namespace pairsum
