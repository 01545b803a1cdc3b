#pragma once
#include <string>
#include <vector>

namespace pairsum::harness {

/// What pairsum_bench measures; set by its own flags, before Google Benchmark sees the rest.
struct bench_request {
  std::string case_name = "dam_break", state = "rest";
  double dx = 0.02;
  std::vector<int> M{6, 7}, threads{1};
};

/// Registers one benchmark per backend x M x threads, "symmetric_omp/dam_break/M:6/threads:2": manual time of the
/// summation phase, counters for the other phases and the work. A backend whose rates are wrong gets an error instead
/// of a time.
void register_backends(const bench_request& r);

/// Registers the parts: "smoothing/wendland_c2", "hashing/M:6", "counting_sort/bits:18".
void register_parts();

}  // namespace pairsum::harness
