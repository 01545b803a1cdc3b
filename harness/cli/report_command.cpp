#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/report/report.hpp"

namespace pairsum::harness {
namespace {

struct options {
  std::vector<std::string> inputs;
  std::string out;
  bool allow_mixed = false;
};

/// Beside a folder's rows, or in a folder named like the rows file.
std::filesystem::path folder_of(const options& o) {
  if (!o.out.empty()) return o.out;
  const std::filesystem::path first = o.inputs.front();
  if (std::filesystem::is_directory(first)) return first;
  return first.parent_path() / first.stem();
}

int report(const options& o) {
  report_options r;
  r.folder = folder_of(o);
  r.allow_mixed = o.allow_mixed;
  const std::vector<std::filesystem::path> inputs(o.inputs.begin(), o.inputs.end());
  fmt::print("{}", make_report(inputs, r));
  fmt::print("summary: {}\n", (r.folder / "summary.json").string());
  return 0;
}

}  // namespace

void add_report_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand("report",
                                               "Tables (text, Markdown, CSV) and summary.json from rows files; rows "
                                               "that failed their verification never enter a\n"
                                               "table, nor do rounds that were cut");
  const auto o = std::make_shared<options>();
  command->add_option("inputs", o->inputs, "rows files, or folders of them")->required();
  command->add_option("--out", o->out, "folder for the files (default: named like the rows file, beside it)");
  command->add_flag("--allow-mixed", o->allow_mixed, "compare rows of different machines or builds nevertheless");
  command->footer("Then look at it:  python3 plots/report.py SUMMARY.json --out report.html");
  command->callback([&chosen, o] { chosen = [o] { return report(*o); }; });
}

}  // namespace pairsum::harness
