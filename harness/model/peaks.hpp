#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pairsum/core/team.hpp>

namespace pairsum::harness {

/// The highest rates measured on the threads of a team.
struct peak_rates {
  double bandwidth_bytes_per_s = 0;  ///< a = b + s c on arrays that outgrow the caches
  double flops_per_s = 0;            ///< independent multiply-adds in registers, 2 flops each
};

/// How large the arrays are and how long to try.
struct peak_limits {
  std::uint64_t last_level_cache_bytes = 0;  ///< the largest cache's size; 0 if unknown
  double budget_s = 1;                       ///< for a call; each loop runs at least twice, whatever the budget
};

/// Bytes of each of the three arrays: 4 times the cache, and no more than 256 MiB (which it is for an unknown cache).
std::size_t triad_array_bytes(std::uint64_t last_level_cache_bytes);

/// The best of several runs in "double", "float" or "mixed" (whose pairs are of float) on the threads of `t`, a serial
/// or an OpenMP team as worker_team makes it; all start at once, and the last one's end counts. A triad's element moves
/// 3 numbers: 24 bytes in double, 12 in float; that the cache line of `a` may be read before it is written is not
/// counted. Memory is first touched by the thread that uses it, asks for large pages, and is given back.
peak_rates measure_peaks(const std::string& precision, const team& t, const peak_limits& limits = {});

/// Multiply-adds per second times 2, on average over `budget_s` seconds, disturbances included: the baseline for sums
/// of the same time.
double measure_multiply_adds(const std::string& precision, const team& t, double budget_s);

namespace peak_loops {

/// a = b + s c, n elements at 64-byte boundaries; n is a multiple of 64 bytes' worth.
template <class R>
void triad(R* a, const R* b, const R* c, R s, std::size_t n);

/// Numbers that multiply_add works on at a time: enough to hide the latency of an operation.
template <class R>
std::size_t multiply_add_width();

/// x = x f + g, `steps` times, for every x of `values`, multiply_add_width() of them.
template <class R>
void multiply_add(std::vector<R>& values, R f, R g, std::uint64_t steps);

}  // namespace peak_loops

}  // namespace pairsum::harness
