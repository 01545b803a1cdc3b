#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/report/compare_sides.hpp"

namespace pairsum::harness {
namespace {

struct compare_options {
  compare_request request;
  std::vector<std::string> inputs{"results"};
  std::string phase = "sum";
};

int compare(const compare_options& o) {
  compare_request r = o.request;
  r.inputs.assign(o.inputs.begin(), o.inputs.end());
  for (const phase_member& p : phase_members)
    if (o.phase + "_s" == p.name) r.phase = p.value;
  std::string words;
  for (const phase_member& p : phase_members) {
    const std::string name = p.name;
    words += (words.empty() ? "" : ", ") + name.substr(0, name.size() - 2);
    if (name == o.phase + "_s") {
      fmt::print("{}", compare_sides(r));
      return 0;
    }
  }
  throw error("unknown phase \"" + o.phase + "\"; valid: " + words);
}

}  // namespace

void add_compare_command(CLI::App& app, action& chosen) {
  CLI::App* const command =
      app.add_subcommand("compare",
                         "Is B faster than A, by how much, and how sure is that? A and B are two backends, with\n"
                         "words like precision=mixed for what else may differ, two rows files (or folders), or two\n"
                         "git revisions that rows were measured with");
  const auto o = std::make_shared<compare_options>();
  command->add_option("A", o->request.a, "the base")->required();
  command->add_option("B", o->request.b, "what is compared with it")->required();
  command->add_option("--in", o->inputs, "rows files or folders that hold the backends or revisions")
      ->capture_default_str();
  command->add_option("--phase", o->phase, "index, prepare, zero, sum, reduce, integrate or total")
      ->capture_default_str();
  command->add_flag("--allow-mixed", o->request.allow_mixed,
                    "compare different machines, or builds with uncommitted changes, nevertheless");
  command->footer(
      "Examples:\n"
      "  pairsum compare naive_omp symmetric_omp --in results/talk\n"
      "  pairsum compare \"symmetric_omp precision=double\" \"tiles_omp precision=mixed\" --in results/vector\n"
      "  pairsum compare before.jsonl after.jsonl\n"
      "  pairsum compare 1a2b3c4d 5e6f7a8b --in results/quick --phase total");
  command->callback([&chosen, o] { chosen = [o] { return compare(*o); }; });
}

}  // namespace pairsum::harness
