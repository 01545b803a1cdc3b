#pragma once

#include "harness/rows/writer.hpp"
#include "tests/rows/example_rows.hpp"

/// Rows with known times.
namespace pairsum::harness::synthetic {

/// How much slower than its stated time a repetition is: the same for all points, so paired ratios
/// are exact. Over the repetitions 1..6 the factors are 1.0, 1.2, 0.8, 1.4, 0.9, 1.1; their median
/// is 1.05.
inline double disturbance(int repetition) {
  constexpr double factors[] = {1.0, 1.2, 0.8, 1.4, 0.9, 1.1};
  return factors[(repetition - 1) % 6];
}

inline sample step(const std::string& backend, int M, int threads, double sum_s, int repetition, int step) {
  sample s = example::measured();
  s.round = 1;
  s.slot = 1;
  s.repetition = repetition;
  s.step = step;
  s.point.backend = backend;
  s.point.M = M;
  s.point.threads = threads;
  // Step 1 takes 0.9 and step 2 takes 1.1 of the time: their mean is the stated time.
  const double t = sum_s * disturbance(repetition) * (step == 1 ? 0.9 : 1.1);
  s.phases = phases{0.25 * t, 0.0, 0.25 * t, t, std::nullopt, 0.5 * t, 2 * t};
  s.work.reset();
  if (step == 1) s.work = work_row{1000, 100, 10, 10, 8000000, 2000000, 900000, 1100000};
  s.threads_busy_s.reset();
  s.barrier_wait_s.reset();
  return s;
}

/// All repetitions, of two steps each, of a point.
inline void write_point(row_writer& writer, const std::string& backend, int M, int threads, double sum_s,
                        int repetitions = 6) {
  for (int repetition = 1; repetition <= repetitions; ++repetition)
    for (int i = 1; i <= 2; ++i) writer.write(step(backend, M, threads, sum_s, repetition, i));
}

}  // namespace pairsum::harness::synthetic
