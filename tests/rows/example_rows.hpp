#pragma once

#include "harness/rows/row.hpp"

/// One row of every kind, with every field set to something that no default equals.
namespace pairsum::harness::example {

inline environment_row environment() {
  environment_row e;
  e.study = "talk";
  e.utc = "2026-11-22T15:30:00.123Z";
  e.environment = "0123456789abcdef";
  e.host = "node";
  e.cpu = "some model";
  e.caches = {{"L1d", 49152}, {"L2", 2097152}, {"L3", 272629760}};
  e.cores = 2;
  e.governor = "performance";
  e.os_kernel = "Linux 6.1";
  e.compiler = "GNU 12.2.0";
  e.flags = "-O3";
  e.libraries = {{"fmt", "9.1.0"}};
  e.git = "abc1234";
  e.dirty = true;
  e.binding = "cores_first 0,1";
  e.counters = "none: no such file";
  e.limits = "2.5 processors, 4 GiB of memory";
  return e;
}

/// Of the samples below, under that name; its traits are those of a copy that tests the harness.
inline backend_row backend() {
  backend_row b;
  b.study = "talk";
  b.utc = "2026-11-22T15:30:00.6Z";
  b.environment = "0123456789abcdef";
  b.name = "symmetric_omp";
  b.description = "the talk's sum, 5 % slower";
  b.aliases = "link cells";
  b.runtime = "omp";
  b.conflicts = "colours";
  b.symmetric = b.deterministic = b.vector = b.blocks = true;
  b.self_test = self_test_row{"slowed 5 %", "naive_omp", 1.05};
  return b;
}

inline sample measured() {
  sample s;
  s.study = "talk";
  s.part = "parallel_rest";
  s.round = 2;
  s.slot = 3;
  s.repetition = 4;
  s.step = 5;
  s.seed = 18446744073709551615u;
  s.utc = "2026-11-22T15:30:01Z";
  s.environment = "0123456789abcdef";
  s.point.case_name = "dam_break";
  s.point.state = "rest";
  s.point.dx = 0.00594;
  s.point.H = 0.01188;
  s.point.n_fluid = 1000000;
  s.point.n_boundary = 1014966;
  s.point.order = "lattice";
  s.point.dim = 2;
  s.point.precision = "double";
  s.point.interaction = "ferrari09";
  s.point.smoothing = "wendland_c2";
  s.point.integrator = "euler";
  s.point.dt = 1e-05;
  s.point.backend = "symmetric_omp";
  s.point.grid = "hashed_grid";
  s.point.M = 6;
  s.point.threads = 2;
  s.point.granularity = "dynamic:32";
  s.point.isa = "native";
  s.phases = phases{0.1, 0.2, 0.3, 0.4, 0.0, 0.6, 1.6};
  s.threads_busy_s = thread_times{{0.25, 0.5}, {0.125, 0.0}};
  s.barrier_wait_s = thread_times{{0.125, 0.0}, {0.0, 0.5}};
  s.work = work_row{262144, 11, 12, 13, 14, 15, 16, 17, 10, {}, 1.5e9, 2.5e8};
  s.counters = counters_row{1000, 2000, std::nullopt};
  s.peak_rss_bytes = 123456789;
  s.workspace_bytes = 9876543;
  s.lost = 3;
  s.threads_worked = 2;
  s.verify = verify_row{1.1e-15, 1e-14, "fedcba9876543210"};
  return s;
}

inline particles_row particles() {
  return particles_row{"talk",
                       "2026-11-22T15:30:00.7Z",
                       "00ff00ff00ff00ff",
                       {"water.csv", "wall.csv:boundary"},
                       {{"H", "0.2", "derived", "2 h of the header"}, {"--rho0", "998", "given", ""}}};
}

/// Of these particles.
inline sample of_files() {
  sample s = measured();
  s.point.case_name = "file";
  s.point.state = "read";
  s.point.particles = "00ff00ff00ff00ff";
  return s;
}

/// A point whose verification failed.
inline sample failed() {
  sample s = measured();
  s.phases.reset();
  s.threads_busy_s.reset();
  s.barrier_wait_s.reset();
  s.counters.reset();
  s.work.reset();
  s.peak_rss_bytes.reset();
  s.workspace_bytes = s.lost = s.threads_worked = std::nullopt;
  s.verify = verify_row{0.5, 1e-14, std::nullopt};
  s.error = "particle 7: relative error 0.5 above its bound 1e-14";
  return s;
}

/// Of two ranks.
inline sample of_ranks() {
  sample s = measured();
  s.point.threads = 1;
  s.point.ranks = 2;
  s.point.cut = "once";
  s.threads_busy_s.reset();
  s.barrier_wait_s.reset();
  s.ranks = {{"node", "0", 600000, 5000, 500000, 17, 6, 0.25, 0.0, {1, 4000}, {2, 300}, {3, 200}, {4, 100}},
             {"node", "1", 400000, 6000, 600000, 18, 7, 0.125, 0.5, {5, 40}, {6, 30}, {7, 20}, {8, 10}}};
  return s;
}

/// Of as many, on too few cores.
inline sample untimed() {
  sample s = of_ranks();
  s.phases.reset();
  for (rank_row& r : *s.ranks) r.busy_s = r.waiting_s = std::nullopt;
  s.untimed = "2 ranks with 1 thread each on 1 core of node";
  return s;
}

inline peak_row peak() {
  return peak_row{"talk", "2026-11-22T15:30:00.5Z", "0123456789abcdef", 2, "double", 1.5e10, 9.5e10};
}

/// In round 2.
inline pace_row pace() { return pace_row{"talk", "2026-11-22T15:30:01Z", "0123456789abcdef", 2, 2, "double", 9e10}; }

/// Closes round 2 of the samples above.
inline round_row closing(std::uint64_t rows = 2) {
  round_row r;
  r.study = "talk";
  r.utc = "2026-11-22T15:30:02Z";
  r.environment = "0123456789abcdef";
  r.round = 2;
  r.part = "parallel_rest";
  r.replicate = 3;
  r.plan = "00112233445566ff";
  r.seed = 7;
  r.rows = rows;
  r.elapsed_s = 12.5;
  r.others_share = 0.25;
  return r;
}

inline end_row ended() {
  return end_row{"talk", "2026-11-22T15:30:03Z", "00112233445566ff", "every part has its rounds"};
}

inline void_row voided() { return void_row{"talk", "2026-11-22T15:30:02.5Z", 2, "the round was not finished"}; }

}  // namespace pairsum::harness::example
