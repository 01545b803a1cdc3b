#include "harness/report/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include <pairsum/core/error.hpp>
#include "harness/report/summary.hpp"
#include "harness/report/tables.hpp"
#include "harness/report/whole_file.hpp"
#include "harness/rows/reader.hpp"

namespace pairsum::harness {
namespace {

std::vector<std::filesystem::path> rows_paths(const std::vector<std::filesystem::path>& given) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path& path : given) {
    if (!std::filesystem::is_directory(path)) {
      paths.push_back(path);
      continue;
    }
    std::vector<std::filesystem::path> inside;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      if (entry.path().extension() == ".jsonl" && !entry.is_directory() && entry.file_size() > 0)  // not begun
        inside.push_back(entry.path());
    if (inside.empty()) throw error(path.string() + ": has no rows files (*.jsonl) in it");
    std::sort(inside.begin(), inside.end());
    paths.insert(paths.end(), inside.begin(), inside.end());
  }
  if (paths.empty()) throw error("a report needs at least one rows file or folder");
  return paths;
}

/// Writes a table; takes away the one that an earlier report left if it has no rows now.
void write_csv(const nlohmann::json& entries, const std::filesystem::path& path) {
  std::error_code none;
  if (entries.empty())
    std::filesystem::remove(path, none);
  else if (entries.front().is_object())
    write_whole_file(print_csv(entries), path);
}

}  // namespace

std::vector<rows_file> read_all_rows(const std::vector<std::filesystem::path>& rows_files_or_folders) {
  std::vector<rows_file> files;
  std::set<std::filesystem::path> seen;
  for (const std::filesystem::path& path : rows_paths(rows_files_or_folders))
    if (seen.insert(std::filesystem::weakly_canonical(path)).second) files.push_back(read_rows(path));
  return files;
}

std::string make_report(const std::vector<std::filesystem::path>& rows_files_or_folders,
                        const report_options& options) {
  const std::vector<rows_file> files = read_all_rows(rows_files_or_folders);
  const bool any = std::ranges::any_of(files, [](const rows_file& f) { return !f.valid_samples().empty(); });
  if (!any)
    throw error("there is no finished round in the rows; a study that was cut goes on when it is started again");
  const nlohmann::json summary = build_summary(files, options.allow_mixed);
  const std::string text = print_tables(summary);
  write_whole_file(summary.dump(1) + "\n", options.folder / "summary.json");
  write_whole_file(text, options.folder / "tables.txt");
  write_whole_file(print_markdown(summary), options.folder / "tables.md");
  for (const auto& item : summary.items())
    if (item.value().is_array()) write_csv(item.value(), options.folder / "csv" / (item.key() + ".csv"));
  return text;
}

}  // namespace pairsum::harness
