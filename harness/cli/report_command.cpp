#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/error.hpp"
#include "harness/cli/commands.hpp"
#include "harness/report/report.hpp"

namespace pairsum::harness {
namespace {

struct options {
  std::vector<std::string> inputs;
  std::string summary;
  bool allow_mixed = false;
};

/// summary.json goes beside a folder's rows, or into a folder named like the rows file.
std::filesystem::path summary_path(const options& o) {
  if (!o.summary.empty()) return o.summary;
  const std::filesystem::path first = o.inputs.front();
  if (std::filesystem::is_directory(first)) return first / "summary.json";
  return first.parent_path() / first.stem() / "summary.json";
}

int report(const options& o) {
  report_options r;
  r.summary_path = summary_path(o);
  r.allow_mixed = o.allow_mixed;
  const std::vector<std::filesystem::path> inputs(o.inputs.begin(), o.inputs.end());
  fmt::print("{}", make_report(inputs, r));
  fmt::print("summary: {}\n", r.summary_path.string());
  return 0;
}

}  // namespace

void add_report_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "report", "Tables and summary.json from rows files; rows that failed their verification never enter a table");
  const auto o = std::make_shared<options>();
  command->add_option("inputs", o->inputs, "rows files, or folders of them")->required();
  command->add_option("--summary", o->summary, "where summary.json goes (default: beside the rows)");
  command->add_flag("--allow-mixed", o->allow_mixed, "compare rows of different machines or builds nevertheless");
  command->footer("Then draw it:  python3 plots/plot.py SUMMARY.json --out FOLDER");
  command->callback([&chosen, o] { chosen = [o] { return report(*o); }; });
}

}  // namespace pairsum::harness
