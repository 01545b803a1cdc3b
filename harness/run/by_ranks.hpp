#pragma once
#include <optional>
#include <string>

namespace pairsum::harness {

/// Has a job of so many ranks carry out the command of this process, whose words it gets, and returns the exit code.
/// None for one rank, and in such a job: then the caller does the work. Throws pairsum::error for a job that ends
/// before its work is done.
/// @param launcher see run_job()
/// @param threads of each rank, at most
std::optional<int> by_ranks(int ranks, const std::string& launcher, int threads);

/// In a job that somebody else started this program in: its first process goes on alone and takes the job's size for
/// the number of ranks that nobody said; returns true in the others, which have nothing to do.
bool left_to_the_first();

/// That number; 1 outside of such a job.
int ranks_unless_said();

}  // namespace pairsum::harness
