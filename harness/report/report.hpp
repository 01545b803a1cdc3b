#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pairsum::harness {

struct report_options {
  std::filesystem::path summary_path;  ///< where summary.json goes
  bool allow_mixed = false;            ///< rows of different machines or builds are no error
};

/// Reads rows files (a folder stands for every *.jsonl in it), writes the summary and returns its
/// tables as text. Throws pairsum::error with one line if a file is no valid rows file, if there
/// are no samples, if the rows are mixed and that is not allowed, or if the summary cannot be
/// written.
std::string make_report(const std::vector<std::filesystem::path>& rows_files_or_folders, const report_options& options);

}  // namespace pairsum::harness
