#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/rows/same_build.hpp"
#include "harness/run/file_lock.hpp"
#include "harness/run/own_environment.hpp"
#include "harness/run/rows_so_far.hpp"
#include "harness/run/study.hpp"

namespace pairsum::harness {
namespace {

/// A file that nobody else has made: two runs may begin in the same second. Where none can be made, its name, and
/// whoever writes to it says why.
std::filesystem::path new_file(const std::filesystem::path& folder, const std::string& stem) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  for (int k = 1;; ++k) {
    const auto path = folder / (k == 1 ? stem + ".jsonl" : fmt::format("{}-{}.jsonl", stem, k));
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file < 0 && errno == EEXIST) continue;
    if (file >= 0) ::close(file);
    return path;
  }
}

}  // namespace

std::filesystem::path rows_path(const std::filesystem::path& results, const study_plan& plan, bool fresh,
                                const std::string& binding) {
  const environment_row here = own_environment(plan, binding);
  const std::filesystem::path folder = results / plan.study;
  std::filesystem::path newest;
  std::error_code code;
  if (!fresh && !here.dirty)  // two builds with uncommitted changes cannot be told apart
    for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
      if (entry.path().extension() != ".jsonl" || entry.path() < newest) continue;
      try {
        const file_lock lock(entry.path());  // refused if it is being written
        const rows_so_far rows(entry.path(), plan);
        const auto& there = rows.rows().environments;
        const bool ours = std::ranges::any_of(there, [&](const environment_row& e) { return same_build(e, here); });
        if (rows.unended() && ours && !rows.rows().former_schema) newest = entry.path();
      } catch (const error&) {  // no rows file, one of another version, or being written: nothing to resume
      }
    }
  if (!newest.empty()) return newest;
  const std::string stem = fmt::format("{}-{}-{}", here.host, utc_stamp(), here.git + (here.dirty ? "-dirty" : ""));
  return new_file(folder, stem);
}

}  // namespace pairsum::harness
