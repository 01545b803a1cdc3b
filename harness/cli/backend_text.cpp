// What `pairsum list backends NAME` says.
#include <fmt/format.h>

#include <algorithm>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/sum/grids.hpp>
#include "harness/cli/list_text.hpp"
#include "harness/cli/list_words.hpp"
#include "harness/plan/plan.hpp"

namespace pairsum::harness {
namespace {

std::string isas_of(const backend_traits& t) {
  if (t.conflicts == conflict_avoidance::atomics) return "scalar";
  std::vector<std::string_view> words{scalar_isa};
  for (const std::string_view isa : isa_names()) words.push_back(isa);
  return fmt::format("{}; default: {}", join(words), t.vector ? best_isa : scalar_isa);
}

/// Is the backend the library's, not a plug-in's?
bool is_of_library(std::string_view name) {
  registry library;
  add_library(library);
  return std::ranges::any_of(library.backends(), [&](const backend_entry& b) { return b.traits.name == name; });
}

}  // namespace

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

std::string backend_text(const std::string& name, const registry& r) {
  std::vector<std::string_view> names;
  for (const backend_entry& b : r.backends()) names.push_back(b.traits.name);
  check_word("backend", name, names);
  const backend_entry& b = r.backends()[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())];
  const backend_traits& t = b.traits;
  std::string text = fmt::format("{}: {}\n", t.name, t.description);
  const auto say = [&](std::string_view what, std::string_view value) {
    if (!value.empty()) text += filled(fmt::format("  {:<14}", what), value, 16);
  };
  if (!b.unavailable.empty()) say("unavailable", b.unavailable);
  say("also called", t.aliases);
  say("family", fmt::format("{}: {}", name_of(t.conflicts), meaning_of(t.conflicts)));
  say("runtime", name_of(t.threads));
  say("each pair",
      t.symmetric ? "is computed once, both particles are updated" : "is computed twice, once for each particle");
  say("same bits", t.deterministic ? "for every number of threads" : "no: they depend on which thread comes first");
  say("lists", t.skin > 0      ? fmt::format("of pairs, kept until a particle has moved by {:g} H", t.skin / 2)
               : t.keeps_pairs ? "of pairs, made in every step"
                               : "");
  say("isa", isas_of(t));
  say("blocks", t.blocks ? "yes: --block auto, slab:N, pencil:N, brick:N" : "no");
  say("grids", join(grid_names()));
  say("precisions", join(precisions_of(b, r)));
  say("source", is_of_library(t.name) ? fmt::format("kernels/backends/{}.cpp", t.name) : "a plug-in");
  if (const auto section = strategy_sections().find(t.name); section != strategy_sections().end())
    say("docs", fmt::format("docs/strategies.md{}", section->second));
  return text;
}

}  // namespace pairsum::harness
