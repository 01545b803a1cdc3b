#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/cli/commands.hpp"
#include "harness/plan/study.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/describe_backend.hpp"

namespace pairsum::harness {
namespace {

/// The precisions for which a backend has a formula in this build.
std::vector<std::string> precisions_of(const backend_entry& b, const registry& r) {
  std::vector<std::string> precisions;
  run_request q;
  q.backends = {std::string(b.traits.name)};
  q.interactions = r.interactions();
  q.smoothings = r.smoothings();
  if (!b.unavailable.empty() || r.dims().empty()) return precisions;
  q.dim = r.dims().front();
  for (const std::string& precision : r.precisions()) {
    q.precisions = {precision};
    if (!expand(q, r).empty()) precisions.push_back(precision);
  }
  return precisions;
}

/// "double, float, mixed (on vector units)"
std::string precisions_text(const registry& r) {
  std::vector<std::string> words = r.precisions();
  for (std::string& word : words)
    if (word == mixed_precision) word += " (on vector units)";
  return join(words);
}

nlohmann::json as_json() {
  const registry& r = registry::instance();
  nlohmann::json all{{"schema", "pairsum.list/1"},
                     {"interactions", r.interactions()},
                     {"smoothings", r.smoothings()},
                     {"precisions", r.precisions()},
                     {"dims", r.dims()},
                     {"grids", grid_names()},
                     {"isas", isa_names()},
                     {"orders", memory_orders},
                     {"states", case_states}};
  for (const backend_entry& b : r.backends()) {
    nlohmann::json entry = describe_backend(b.traits);
    for (const char* of_a_study : {"schema", "kind", "study", "utc", "environment", "self_test"})
      entry.erase(of_a_study);
    entry["precisions"] = precisions_of(b, r);
    entry["unavailable"] = b.unavailable.empty() ? nlohmann::json() : nlohmann::json(b.unavailable);
    all["backends"].push_back(std::move(entry));
  }
  all["grids_with_M"] = nlohmann::json::array();
  for (const std::string_view grid : grid_names())
    if (grid_takes_M(grid)) all["grids_with_M"].push_back(grid);
  all["plain_interactions"] = nlohmann::json::array();
  for (const std::string& i : r.interactions())
    if (!r.is_smoothed(i)) all["plain_interactions"].push_back(i);  // those that take no smoothing kernel
  for (const combination& f : r.formulas())
    all["formulas"].push_back({{"dim", f.dim},
                               {"precision", f.precision},
                               {"interaction", f.interaction},
                               {"smoothing", f.smoothing.empty() ? nlohmann::json() : nlohmann::json(f.smoothing)}});
  all["unavailable"] = nlohmann::json::array();
  for (const missing_word& m : r.missing())
    all["unavailable"].push_back({{"kind", m.kind}, {"word", m.word}, {"option", m.option}});
  for (const case_entry& c : case_entries()) all["cases"].push_back({{"name", c.name}, {"description", c.description}});
  for (const integrator_entry& i : integrator_entries())
    all["integrators"].push_back({{"name", i.name}, {"description", i.description}});
  for (const shipped_plan& p : shipped_plans())
    all["plans"].push_back({{"name", p.name}, {"title", load_plan(std::string(p.name)).at("title")}});
  return all;
}

void print_text() {
  const registry& r = registry::instance();
  fmt::print("backends\n");
  for (const backend_entry& b : r.backends()) {
    fmt::print("  {:<20} {:<7}{}\n", b.traits.name, name_of(b.traits.threads), b.traits.description);
    fmt::print("  {:<28}also: {}\n", "", b.traits.aliases);
    if (!b.unavailable.empty()) fmt::print("  {:<28}unavailable: {}\n", "", b.unavailable);
  }
  fmt::print("cases\n");
  for (const case_entry& c : case_entries()) fmt::print("  {:<20} {}\n", c.name, c.description);
  fmt::print("integrators\n");
  for (const integrator_entry& i : integrator_entries()) fmt::print("  {:<20} {}\n", i.name, i.description);
  fmt::print("plans (pairsum run NAME)\n");
  for (const shipped_plan& p : shipped_plans())
    fmt::print("  {:<20} {}\n", p.name, load_plan(std::string(p.name)).at("title").get<std::string>());
  std::vector<std::string> dims;
  for (const int d : r.dims()) dims.push_back(fmt::format("{}D", d));
  for (const missing_word& m : r.missing())
    fmt::print("unavailable       {} {}: not in this build, configure with -D{}=all\n", m.kind, m.word, m.option);
  fmt::print(
      "interactions      {}\nsmoothing kernels {}\nprecisions        {}\ndimensions        {}\ngrids             {}\n"
      "orders of memory  {}\nstates            {}\ninstruction sets  {}\n",
      join(r.interactions()), join(r.smoothings()), precisions_text(r), join(dims), join(grid_names()),
      join(memory_orders), join(case_states), join(isa_names()));
}

}  // namespace

void add_list_command(CLI::App& app, action& chosen) {
  CLI::App* const command =
      app.add_subcommand("list", "What there is: backends, cases, integrators, plans, interactions, kernels, grids");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  add_plugin_option(*command);
  command->callback([&chosen, json] {
    chosen = [json] {
      if (*json)
        fmt::print("{}\n", as_json().dump(2));
      else
        print_text();
      return 0;
    };
  });
}

}  // namespace pairsum::harness
