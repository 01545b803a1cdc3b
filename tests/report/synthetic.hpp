#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/rows/write_sample.hpp"

/// Rows with known times.
namespace pairsum::harness::synthetic {

/// How much slower than stated everything in a round is: the same for all points, so paired ratios are exact. Over the
/// rounds 1..6 the factors are 1.0, 1.2, 0.8, 1.4, 0.9, 1.1; their median is 1.05.
inline double disturbance(int round) {
  constexpr double factors[] = {1.0, 1.2, 0.8, 1.4, 0.9, 1.1};
  return factors[(round - 1) % 6];
}

/// A point of a made-up study, with its summation time.
struct made_point {
  std::string backend;
  int M;
  int threads;
  double sum_s;
  int rounds = 6;                            ///< the first ones, in which it was measured
  std::function<void(sample&)> change = {};  ///< the last word on each of its rows
};

inline work_row work() { return {1000, 100, 10, 10, 8000000, 2000000, 900000, 1100000, 6000000}; }

/// Sets the times of a step: half of the total is the sum.
inline void set_times(sample& s, double sum_s) {
  s.phases = phases{0.25 * sum_s, 0.0, 0.25 * sum_s, sum_s, std::nullopt, 0.5 * sum_s, 2 * sum_s};
}

inline sample step(const made_point& p, int round, int step) {
  sample s = example::measured();
  s.round = round;
  s.slot = 1;
  s.repetition = 1;
  s.step = step;
  s.point.backend = p.backend;
  s.point.M = p.M;
  s.point.threads = p.threads;
  // Step 1 takes 0.9 and step 2 takes 1.1 of the time: their mean is the stated time.
  set_times(s, p.sum_s * disturbance(round) * (step == 1 ? 0.9 : 1.1));
  s.work.reset();
  if (step == 1) s.work = work();
  s.threads_busy_s.reset();
  s.barrier_wait_s.reset();
  s.counters.reset();
  if (p.change) p.change(s);
  return s;
}

/// Closes a round of so many rows.
inline round_row closing(int round, std::size_t rows, double others_share = 0.01) {
  round_row r = example::closing(rows);
  r.round = round;
  r.replicate = round;
  r.others_share = others_share;
  return r;
}

/// A round with two steps of each point, and the row that closes it.
inline void write_round(row_writer& writer, int round, const std::vector<made_point>& points, bool close = true) {
  std::size_t rows = 0;
  for (const made_point& p : points)
    for (int i = 1; i <= 2 && round <= p.rounds; ++i, ++rows) write_sample(writer, step(p, round, i));
  if (close) writer.write(closing(round, rows));
}

/// The rounds 1 to `rounds`; the environment row must be there.
inline void write_rounds(row_writer& writer, const std::vector<made_point>& points, int rounds = 6) {
  for (int round = 1; round <= rounds; ++round) write_round(writer, round, points);
}

/// The paces of rounds 1 to 6 on 1 and 2 threads; write them before the rounds.
inline void write_paces(row_writer& writer, double one, double two) {
  pace_row pace = example::pace();
  for (pace.round = 1; pace.round <= 6; ++pace.round)
    for (pace.threads = 1; pace.threads <= 2; ++pace.threads) {
      pace.flops_per_s = (pace.threads == 1 ? one : two) / disturbance(pace.round);
      writer.write(pace);
    }
}

/// Multiplies the times of round k by exp(logs[k - 1]).
inline std::function<void(sample&)> scattered(std::vector<double> logs) {
  return [logs](sample& s) {
    const double factor = std::exp(logs.at(static_cast<std::size_t>(s.round - 1)));
    for (const phase_member& phase : phase_members)
      if (auto& time = (*s.phases).*phase.value) *time *= factor;
  };
}

}  // namespace pairsum::harness::synthetic
