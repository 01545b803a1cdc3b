#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

namespace pairsum {

/// What control groups (a container's, a batch system's) leave this process of the machine; empty where they set no
/// limit.
struct job_limits {
  std::optional<double> cpus;           ///< processors' worth of time; beyond it threads are paused
  std::optional<std::uint64_t> memory;  ///< bytes
};

/// The limits of the control groups that this process is in, of version 1 and 2, and of all groups above them that can
/// be seen: https://docs.kernel.org/admin-guide/cgroup-v2.html and cgroup-v1/. `root` is where /proc and the mount
/// points begin.
job_limits read_job_limits(const std::filesystem::path& root = "/");

/// The same, as it was when first asked.
const job_limits& limits_of_this_job();

}  // namespace pairsum
