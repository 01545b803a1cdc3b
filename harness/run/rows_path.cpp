#include <fmt/format.h>

#include <algorithm>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/rows/same_build.hpp"
#include "harness/run/file_lock.hpp"
#include "harness/run/own_environment.hpp"
#include "harness/run/rows_so_far.hpp"
#include "harness/run/study.hpp"

namespace pairsum::harness {

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
  std::filesystem::path made = folder / (stem + ".jsonl");
  for (int k = 2; std::filesystem::exists(made, code); ++k) made = folder / fmt::format("{}-{}.jsonl", stem, k);
  return made;  // two runs may begin in the same second
}

}  // namespace pairsum::harness
