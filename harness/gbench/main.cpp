#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <optional>

#include <pairsum/core/error.hpp>
#include "harness/cli/profile_levels.hpp"
#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/gbench/bench.hpp"
#include "harness/gbench/out_file.hpp"
#include "harness/measure/memory.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/refusal.hpp"
#include "harness/plan/variants.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/terminal/program.hpp"

namespace {

using namespace pairsum::harness;

/// What the program takes out of the command line; the other words are Google Benchmark's.
struct words_given {
  bench_request request;
  std::string out, out_format = "json", format = "console";
  std::vector<std::string> rest;
};

/// Those of Google Benchmark's options with which it does something else than it was told, or says nothing: it gets
/// them when they were found to be right.
void add_checked_options(CLI::App& app, words_given& w, std::optional<double>& least_s,
                         std::optional<std::int64_t>& times) {
  app.add_option("--benchmark_out", w.out)->envname("BENCHMARK_OUT");
  const CLI::IsMember known({"json", "console", "csv"});
  app.add_option("--benchmark_out_format", w.out_format)->envname("BENCHMARK_OUT_FORMAT")->check(known);
  app.add_option("--benchmark_format", w.format)->envname("BENCHMARK_FORMAT")->check(known);
  app.add_option("--benchmark_min_time", least_s)->envname("BENCHMARK_MIN_TIME");
  app.add_option("--benchmark_repetitions", times)->envname("BENCHMARK_REPETITIONS");
}

words_given parse(int argc, char** argv) {
  CLI::App app("", "pairsum_bench");
  words_given w;
  bench_request& r = w.request;
  bool oversubscribe = false;
  std::map<std::string, std::string> levels{
      {"case", "dam_break"}, {"dx", "0.02"},    {"state", "rest"},      {"H", "0"}, {"M", "6,7"}, {"threads", "all"},
      {"isa", "default"},    {"block", "auto"}, {"grid", "hashed_grid"}};
  std::optional<double> least_s;
  std::optional<std::int64_t> times;
  app.allow_extras();
  app.set_help_flag("");
  for (auto& [level, text] : levels) app.add_option(option_of(level), text);
  add_particle_options(app, levels);
  app.add_option("--binding", r.binding);
  app.add_flag("--oversubscribe", oversubscribe);
  add_plugin_option(app);
  add_checked_options(app, w, least_s, times);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    throw refusal(app, e, {"M", "threads", "grid", "isa", "block"});
  }
  if (least_s && !(*least_s > 0 && std::isfinite(*least_s)))
    throw pairsum::error(fmt::format("--benchmark_min_time must be positive and finite, is {}", *least_s));
  if (constexpr int most = 1000000; times && (*times < 1 || *times > most))
    throw pairsum::error(fmt::format("--benchmark_repetitions must be at least 1 and at most {}, is {}", most, *times));
  load_named_plugins();
  w.rest = app.remaining();
  w.rest.push_back("--benchmark_format=" + w.format);
  if (!w.out.empty()) w.rest.push_back("--benchmark_out=" + w.out);
  if (least_s) w.rest.push_back(fmt::format("--benchmark_min_time={}", *least_s));
  if (times) w.rest.push_back(fmt::format("--benchmark_repetitions={}", *times));
  levels["backend"] = fmt::format("{}", fmt::join(available_backends(), ","));
  r.levels = levels_of(levels, "", given_of(app));
  fmt::print(stderr, "{}", take_particles(r.levels));
  fmt::print(stderr, "{}", leave_out_wide_skins(r.levels, pairsum::registry::instance()));
  check_request(r.levels);
  check_cores(r.levels.threads, oversubscribe);
  return w;
}

int run(int argc, char** argv) {
  words_given given = parse(argc, argv);
  std::vector<char*> words{argv[0]};
  for (std::string& w : given.rest) {
    if (w == "--help" || w == "-h") {
      fmt::print(
          "pairsum_bench [--case NAME] [--dx M] [--state rest|perturbed] [--H M] [--particles FILES] [--M 6,7] "
          "[--threads 1,2|all] "
          "[--grid NAMES] [--isa NAMES] [--block auto,slab:4] [--binding cores_first|none] [--oversubscribe] "
          "[--plugin FILE] [--benchmark_filter=REGEX ...]\n");
      benchmark::PrintDefaultHelp();
      return 0;
    }
    words.push_back(w.data());
  }
  int n = static_cast<int>(words.size());
  benchmark::Initialize(&n, words.data());
  if (benchmark::ReportUnrecognizedArguments(n, words.data())) return 2;
  out_file out(given.out, given.out_format);
  keep_freed_memory();
  benchmark::AddCustomContext("pairsum", describe_build());
  if (const std::string note = limits_note(); !note.empty()) benchmark::AddCustomContext("limits", note);
  for (const auto& [name, file] : loaded_plugins()) benchmark::AddCustomContext("plugin " + name, file);
  benchmark::AddCustomContext("binding", register_backends(given.request));
  register_parts();
  // It has said what is wrong with the filter where that leaves none.
  const bool any = benchmark::RunSpecifiedBenchmarks(nullptr, out.reporter()) > 0;
  benchmark::Shutdown();
  out.check();
  return !any ? 2 : any_failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  return as_program("pairsum_bench", [&] { return run(argc, argv); });
}
