#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/list_text.hpp"
#include "harness/plan/study.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/describe_backend.hpp"

namespace pairsum::harness {
namespace {

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
                     {"states", case_state_words()}};
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

int list(const std::string& kind, const std::string& name, bool json) {
  const registry& r = registry::instance();
  if (json && !kind.empty()) throw error("list --json prints everything there is; it takes no " + kind);
  if (!name.empty() && kind != "backends") throw error("list tells more of one of the backends alone, not of " + kind);
  fmt::print("{}", json           ? as_json().dump(2) + "\n"
                   : kind.empty() ? overview_text(r)
                   : name.empty() ? kind_text(kind, r)
                                  : backend_text(name, r));
  return 0;
}

}  // namespace

void add_list_command(CLI::App& app, action& chosen) {
  struct options {
    std::string kind, name;
    bool json = false;
  };
  CLI::App* const command =
      app.add_subcommand("list", "What there is: backends, plans, cases, interactions, smoothing kernels, grids, ...");
  const auto o = std::make_shared<options>();
  command->add_option("kind", o->kind,
                      "more of one kind: backends, plans, cases, interactions, smoothings, integrators, grids, "
                      "precisions, dims, orders, states, isas");
  command->add_option("name", o->name, "of a backend: all that it says of itself");
  command->add_flag("--json", o->json, "everything as JSON");
  add_plugin_option(*command);
  command->footer(
      "Examples:\n"
      "  pairsum list                      all kinds of words, on one screen\n"
      "  pairsum list backends             a line each\n"
      "  pairsum list backends tiles_omp   its traits, source and documentation\n"
      "  pairsum list plans                what each asks, and whether this build can carry it out");
  command->callback([&chosen, o] { chosen = [o] { return list(o->kind, o->name, o->json); }; });
}

}  // namespace pairsum::harness
