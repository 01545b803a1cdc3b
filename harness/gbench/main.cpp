#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/gbench/bench.hpp"
#include "harness/measure/memory.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/words.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/terminal/program.hpp"

namespace {

using namespace pairsum::harness;

/// Takes the program's own flags out of the command line; what is left is Google Benchmark's.
bench_request parse(CLI::App& app, int argc, char** argv, std::vector<std::string>& rest) {
  bench_request r;
  bool oversubscribe = false;
  std::string M = "6,7", threads = "all", grid = "hashed_grid", isa = "default", block = "auto";
  app.allow_extras();
  app.set_help_flag("");
  app.add_option("--case", r.case_name);
  app.add_option("--dx", r.dx);
  app.add_option("--state", r.state);
  app.add_option("--M", M);
  app.add_option("--threads", threads);
  app.add_option("--grid", grid);
  app.add_option("--isa", isa);
  app.add_option("--block", block);
  app.add_flag("--oversubscribe", oversubscribe);
  add_plugin_option(app);
  app.parse(argc, argv);
  load_named_plugins();
  rest = app.remaining();
  r.M = parse_counts("--M", M, 0);
  r.threads = parse_counts("--threads", threads, usable_cores());
  r.grids = parse_words("--grid", grid);
  r.isas = parse_words("--isa", isa);
  r.blocks = parse_words("--block", block);
  check_request(as_run(r));
  check_cores(r.threads, oversubscribe);
  return r;
}

int run(int argc, char** argv) {
  CLI::App app;
  std::vector<std::string> rest;
  const bench_request r = parse(app, argc, argv, rest);
  std::vector<char*> words{argv[0]};
  for (std::string& w : rest) {
    if (w == "--help" || w == "-h") {
      fmt::print(
          "pairsum_bench [--case NAME] [--dx M] [--state rest|perturbed] [--M 6,7] [--threads 1,2|all] "
          "[--grid NAMES] [--isa NAMES] [--block auto,slab:4] [--oversubscribe] [--plugin FILE] "
          "[--benchmark_filter=REGEX ...]\n");
      benchmark::PrintDefaultHelp();
      return 0;
    }
    words.push_back(w.data());
  }
  int n = static_cast<int>(words.size());
  benchmark::Initialize(&n, words.data());
  if (benchmark::ReportUnrecognizedArguments(n, words.data())) return 2;
  keep_freed_memory();
  benchmark::AddCustomContext("pairsum", describe_build());
  if (const std::string note = limits_note(); !note.empty()) benchmark::AddCustomContext("limits", note);
  for (const auto& [name, file] : loaded_plugins()) benchmark::AddCustomContext("plugin " + name, file);
  register_backends(r);
  register_parts();
  const bool any = benchmark::RunSpecifiedBenchmarks() > 0;  // or the library has said what is wrong with the filter
  benchmark::Shutdown();
  return !any ? 2 : any_failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  return as_program("pairsum_bench", [&] { return run(argc, argv); });
}
