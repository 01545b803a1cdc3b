#pragma once
#include <string>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// What pairsum_bench measures; set by its own flags, before Google Benchmark sees the rest.
struct bench_request {
  run_request levels;  ///< of every backend that is built
  std::string binding = "cores_first";
};

/// Registers one benchmark per backend x grid x M x threads, "symmetric_omp/dam_break/M:6/threads:2" or
/// "symmetric_omp/dam_break/compact_grid/threads:2", with isa and block where a backend chooses them: manual time of
/// the summation phase, counters for the other phases and the work. A backend whose rates are wrong gets an error
/// instead of a time.
/// @return how threads are bound
std::string register_backends(const bench_request& r);

/// Did a backend have wrong rates?
bool any_failed();

/// Registers the parts: "smoothing/wendland_c2", "hashing/M:6", "counting_sort/bits:18".
void register_parts();

}  // namespace pairsum::harness
