#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>

#include <pairsum/core/error.hpp>
#include <pairsum/core/job_limits.hpp>
#include <pairsum/core/memory.hpp>
#include "harness/environment/machine.hpp"

// The machine as a job sees it: control groups in a folder that looks like / to a process in them.
namespace pairsum::harness {
namespace {

class control_groups : public testing::Test {
 protected:
  const std::filesystem::path root_ =
      std::filesystem::path(testing::TempDir()) /
      ("pairsum_groups_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));

  control_groups() { std::filesystem::remove_all(root_); }
  ~control_groups() override { std::filesystem::remove_all(root_); }

  void put(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }
  job_limits read() const { return read_job_limits(root_); }
};

TEST_F(control_groups, that_are_not_there_limit_nothing) {
  EXPECT_EQ(limits_text(read()), "none");
  put("proc/self/mountinfo", "25 1 8:1 / / rw - ext4 /dev/root rw\nnot a line of mounts");
  put("proc/self/cgroup", "0::/\nnor of groups");
  EXPECT_EQ(limits_text(read()), "none");
}

TEST_F(control_groups, of_version_2_limit_with_all_their_parents) {
  put("proc/self/mountinfo", "30 24 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate");
  put("proc/self/cgroup", "0::/batch.slice/job_7");
  put("sys/fs/cgroup/batch.slice/job_7/cpu.max", "max 100000");
  put("sys/fs/cgroup/batch.slice/job_7/memory.max", "max");
  EXPECT_EQ(limits_text(read()), "none");
  put("sys/fs/cgroup/batch.slice/cpu.max", "250000 100000");
  put("sys/fs/cgroup/batch.slice/memory.max", "4294967296");
  EXPECT_EQ(limits_text(read()), "2.5 processors, 4 GiB of memory");
  put("sys/fs/cgroup/batch.slice/job_7/cpu.max", "50000 100000");
  EXPECT_EQ(read().cpus, 0.5) << "the least of them";
  put("sys/fs/cgroup/other/cpu.max", "10000 100000");
  EXPECT_EQ(read().cpus, 0.5) << "a group that the process is not in";
}

TEST_F(control_groups, of_version_1_limit_each_in_its_hierarchy) {
  put("proc/self/mountinfo",
      "31 30 0:28 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"
      "34 30 0:31 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
      "40 30 0:37 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw");
  put("proc/self/cgroup", "4:memory:/user\n2:cpu,cpuacct:/job\n0::/");
  put("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "-1");
  put("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "100000");
  put("sys/fs/cgroup/memory/user/memory.limit_in_bytes", "9223372036854771712");
  put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "1048576");
  EXPECT_EQ(limits_text(read()), "none");
  put("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "150000");
  put("sys/fs/cgroup/memory/user/memory.limit_in_bytes", "1073741824");
  EXPECT_EQ(limits_text(read()), "1.5 processors, 1 GiB of memory");
}

/// Docker without a namespace of its own: the path is the host's, and what is mounted is the group itself.
TEST_F(control_groups, of_a_container_are_read_where_they_are_mounted) {
  put("proc/self/mountinfo",
      "31 30 0:28 /docker/1a2b /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n"
      "34 30 0:31 /docker/1a2b /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory");
  put("proc/self/cgroup", "4:memory:/docker/1a2b\n2:cpu:/docker/1a2b/inner");
  put("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "300000");
  put("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "2147483648");
  EXPECT_EQ(limits_text(read()), "3 processors, 2 GiB of memory");
  put("sys/fs/cgroup/cpu/inner/cpu.cfs_quota_us", "100000");
  put("sys/fs/cgroup/cpu/inner/cpu.cfs_period_us", "100000");
  EXPECT_EQ(read().cpus, 1);
}

TEST(machine, counts_whole_processors_of_a_quota) {
  const auto cores = [](double cpus) { return cores_within(8, {cpus, {}}); };
  EXPECT_EQ(cores_within(8, {}), 8);
  EXPECT_EQ(cores(2.0), 2);
  EXPECT_EQ(cores(2.9), 2) << "a third thread would be paused for a tenth of the time";
  EXPECT_EQ(cores(0.3), 1);
  EXPECT_EQ(cores(64), 8);
  EXPECT_EQ(cores(1e300), 8);
}

TEST(machine, says_what_a_quota_leaves) {
  EXPECT_EQ(limits_note(8, {}), "");
  EXPECT_EQ(limits_note(2, {2.0, {}}), "") << "nobody is paused";
  EXPECT_EQ(limits_note(8, {2.5, {}}),
            "a control group gives this job 2.5 of 8 hardware threads: 2 count as all of them");
  EXPECT_NE(limits_note(2, {0.5, {}}).find("even that one is paused"), std::string::npos);
}

TEST(machine, has_the_threads_that_the_process_was_given) {
  cpu_set_t set;
  ASSERT_EQ(sched_getaffinity(0, sizeof set, &set), 0);
  EXPECT_EQ(units_given(), CPU_COUNT(&set));
  EXPECT_EQ(usable_cores(), cores_within(units_given(), limits_of_this_job()));
  check_cores({1, usable_cores()}, false);
  check_cores({usable_cores() + 1}, true);
  EXPECT_THROW(check_cores({1, usable_cores() + 1}, false), error);
}

TEST(machine, has_no_more_memory_than_its_groups_leave) {
  EXPECT_GT(usable_memory(), 0);
  EXPECT_LE(usable_memory(), static_cast<double>(limits_of_this_job().memory.value_or(1ull << 60)));
}

}  // namespace
}  // namespace pairsum::harness
