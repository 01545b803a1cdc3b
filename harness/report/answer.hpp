#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

/// Which backend, M and number of threads to take for the largest problem that was measured: the one whose whole step
/// (index, prepare, zero, sum, reduce, integrate) has the smallest median, with those that no difference was resolved
/// from (Holm), and how many times faster it is than the fastest naive backend on as many threads. null if nothing but
/// self-test backends was measured.
nlohmann::json answer(const measurements& all);

/// The talk's questions, answered in words from the tables of the summary, as far as they were measured: is the
/// symmetric sum twice as fast, does it scale as well, which M for which algorithm and why, OpenMP or oneTBB, how far
/// from what the machine can do.
nlohmann::json questions(const nlohmann::json& summary);

}  // namespace pairsum::harness
