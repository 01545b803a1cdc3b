#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/rows/reader.hpp"

namespace pairsum::harness {

/// The rows of files, and of every *.jsonl in folders, each file once. Throws pairsum::error with one line if there is
/// none or one is no valid rows file.
std::vector<rows_file> read_all_rows(const std::vector<std::filesystem::path>& rows_files_or_folders);

struct report_options {
  std::filesystem::path folder;  ///< where the files go
  bool allow_mixed = false;      ///< rows of different machines or builds are no error
};

/// Reads rows files (a folder stands for every *.jsonl in it), writes summary.json, tables.txt, tables.md and a
/// csv/*.csv for every table that is not empty, and returns the tables as text. Each file is there whole or as it was.
/// Throws pairsum::error with one line if a file is no valid rows file, if there is no finished round, if the rows are
/// mixed and that is not allowed, or if the files cannot be written.
std::string make_report(const std::vector<std::filesystem::path>& rows_files_or_folders, const report_options& options);

}  // namespace pairsum::harness
