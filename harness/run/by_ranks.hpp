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

/// For a program that runs inside an MPI job that the user started. The job's first process goes on alone; the job's
/// size becomes its default number of ranks. Returns true in the other processes, which have nothing to do.
bool left_to_the_first();

/// The default number of ranks: the size of such a job, 1 outside of one.
int default_ranks();

}  // namespace pairsum::harness
