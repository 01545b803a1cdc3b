#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/run/order.hpp"

namespace pairsum::harness {

/// What starts the ranks of an MPI job, as words: "mpirun", "srun", "mpirun --hostfile hosts". The number of ranks and
/// what leaves the binding of threads to this program are put behind.
inline constexpr const char* default_launcher = "mpirun";

/// Has a program of pairsum carry out `words` as so many ranks of an MPI job, and hands on what the first of them
/// writes to stdout. A job that was ended by a signal to one of its ranks departs with that signal. Throws
/// pairsum::error if the launcher cannot be run or starts nothing.
/// @param input what the first rank reads from stdin
/// @param crowded there are more threads than cores: ranks that wait yield
departure run_job(const std::string& launcher, const std::filesystem::path& program, int ranks,
                  const std::vector<std::string>& words, const std::string& input, bool crowded);

/// The words of the launcher for so many ranks, without those of the program.
std::vector<std::string> launcher_words(const std::string& launcher, int ranks);

/// Of an MPI job that somebody else started this program in: its size, and the rank of this process. Else 1 and 0.
struct outer_job {
  int size = 1, rank = 0;
};
outer_job outer_job_here();

/// Forgets that job, so that another can be started from this process.
void leave_outer_job();

}  // namespace pairsum::harness
