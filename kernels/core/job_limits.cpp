#include <pairsum/core/job_limits.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace pairsum {
namespace {

using std::filesystem::path;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, at);) words.push_back(word);
  return words;
}

std::vector<std::string> lines_of(const path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The numbers of a file of one line; empty for "max", and where there is no such file.
std::vector<double> numbers_of(const path& file) {
  std::ifstream in(file);
  std::vector<double> numbers;
  for (double value; in >> value;) numbers.push_back(value);
  return numbers;
}

template <class T>
void lower(std::optional<T>& limit, double to) {
  if (!limit || to < static_cast<double>(*limit)) limit = static_cast<T>(to);
}

void read_group(const path& group, job_limits& limits) {
  if (const auto n = numbers_of(group / "cpu.max"); n.size() == 2 && n[1] > 0) lower(limits.cpus, n[0] / n[1]);
  const auto quota = numbers_of(group / "cpu.cfs_quota_us"), period = numbers_of(group / "cpu.cfs_period_us");
  if (!quota.empty() && quota[0] > 0 && !period.empty() && period[0] > 0) lower(limits.cpus, quota[0] / period[0]);
  constexpr double unlimited =
      4.6e18;  // what version 1 says where it sets none, 2^63 less a page, and more than exists
  for (const char* name : {"memory.max", "memory.limit_in_bytes"})
    if (const auto n = numbers_of(group / name); !n.empty() && n[0] < unlimited) lower(limits.memory, n[0]);
}

/// A mounted hierarchy of control groups; `controllers` are "" for version 2.
struct hierarchy {
  std::string mounted, at;  ///< the group that is mounted, and where
  std::vector<std::string> controllers;
};

/// See proc(5), /proc/pid/mountinfo: 36 35 98:0 /mounted /at options ... - type source super,options
std::vector<hierarchy> hierarchies(const path& root) {
  std::vector<hierarchy> all;
  for (const std::string& line : lines_of(root / "proc/self/mountinfo")) {
    const auto words = split(line, ' ');
    const auto dash = std::ranges::find(words, "-");
    if (words.end() - dash < 4 || dash - words.begin() < 5) continue;
    if (dash[1] == "cgroup2") all.push_back({words[3], words[4], {""}});
    if (dash[1] == "cgroup") all.push_back({words[3], words[4], split(dash[3], ',')});
  }
  return all;
}

}  // namespace

job_limits read_job_limits(const path& root) {
  job_limits limits;
  const auto memberships = lines_of(root / "proc/self/cgroup");  // id:controllers:group
  for (const hierarchy& h : hierarchies(root))
    for (const std::string& line : memberships) {
      const std::size_t first = line.find(':'), second = line.find(':', first + 1);
      if (second == line.npos) continue;
      auto names = split(line.substr(first + 1, second - first - 1), ',');
      if (names.empty()) names = {""};
      if (std::ranges::find_first_of(h.controllers, names) == h.controllers.end()) continue;
      std::string group = line.substr(second + 1);
      if (h.mounted != "/")  // a container sees its own group mounted, and may or may not be told the path to it
        group = group.starts_with(h.mounted) ? group.substr(h.mounted.size()) : "";
      const path top = root / path(h.at).relative_path();
      for (path below = path(group).relative_path();; below = below.parent_path()) {
        read_group(top / below, limits);
        if (below.empty()) break;
      }
    }
  return limits;
}

const job_limits& limits_of_this_job() {
  static const job_limits limits = read_job_limits();
  return limits;
}

}  // namespace pairsum
