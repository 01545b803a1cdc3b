#include "harness/cli/list_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/grids.hpp>
#include "harness/environment/machine.hpp"
#include "harness/run/worker.hpp"
#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

template <class Names>
std::vector<listed_word> plain(const Names& names) {
  std::vector<listed_word> all;
  for (const auto& name : names) all.push_back({std::string(name), ""});
  return all;
}

template <class Entries>
std::vector<listed_word> described(const Entries& entries) {
  std::vector<listed_word> all;
  for (const auto& e : entries) all.push_back({std::string(e.name), std::string(e.description)});
  return all;
}

}  // namespace

std::vector<std::string> obstacles(const study_plan& plan) {
  std::vector<std::string> all;
  if (plan.builds > 1) all.emplace_back("compares two builds: name the other with --program");
  for (const auto& [part, why] : measurable(plan, registry_of(plan)).left_out)
    for (const std::string& line : why)
      if (std::ranges::find(all, line) == all.end()) all.push_back(line);
  return all;
}

study_plan plan_named(std::string_view name) { return parse_plan(load_plan(std::string(name)), usable_cores()); }

const std::vector<kind_of_word>& kinds() {
  static const std::vector<kind_of_word> all{
      {"backends", "",
       [](const registry& r) {
         std::vector<listed_word> words;
         for (const backend_entry& b : r.backends())
           words.push_back({std::string(b.traits.name), "", b.unavailable.empty()});
         return words;
       }},
      {"plans", "",
       [](const registry&) {
         std::vector<listed_word> words;
         for (const shipped_plan& p : shipped_plans())
           words.push_back({std::string(p.name), "", obstacles(plan_named(p.name)).empty()});
         return words;
       }},
      {"cases", "", [](const registry&) { return described(case_entries()); }},
      {"interactions", "interaction",
       [](const registry& r) {
         std::vector<listed_word> words = plain(r.interactions());
         for (listed_word& e : words)
           e.text = r.is_smoothed(e.word) ? "takes a smoothing kernel" : "takes no smoothing kernel";
         return words;
       }},
      {"smoothings", "smoothing kernel", [](const registry& r) { return plain(r.smoothings()); }},
      {"integrators", "", [](const registry&) { return described(integrator_entries()); }},
      {"grids", "",
       [](const registry&) {
         std::vector<listed_word> words = plain(grid_names());
         for (listed_word& e : words) e.text = grid_takes_M(e.word) ? "takes M" : "takes no M";
         return words;
       }},
      {"precisions", "precision",
       [](const registry& r) {
         std::vector<listed_word> words = plain(r.precisions());
         for (listed_word& e : words)
           if (e.word == mixed_precision) e.text = "state and sums in double, pairs in float on vector units";
         return words;
       }},
      {"dims", "dimension",
       [](const registry& r) {
         std::vector<listed_word> words;
         for (const int d : r.dims()) words.push_back({std::to_string(d), ""});
         return words;
       }},
      {"orders", "", [](const registry&) { return plain(memory_orders); }},
      {"states", "", [](const registry&) { return plain(case_state_words()); }},
      {"isas", "", [](const registry&) {
         std::vector<listed_word> words = plain(isa_names());
         words.push_back({std::string(scalar_isa), "no vector units"});
         return words;
       }}};
  return all;
}

std::vector<listed_word> entries_of(const kind_of_word& kind, const registry& r) {
  std::vector<listed_word> all = kind.entries(r);
  for (const missing_word& m : r.missing())
    if (m.kind == kind.missing)
      all.push_back({m.word, fmt::format("not in this build; configure with -D{}=all", m.option), false});
  return all;
}

std::string filled(std::string line, std::string_view words, std::size_t indent) {
  std::string text;
  bool begun = false;
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(words.size(), word.size() + 1));
    if (begun && columns_in(line) + 1 + columns_in(word) > screen) {
      text += line + "\n";
      line = std::string(indent, ' ');
      begun = false;
    }
    line += (begun ? " " : "") + std::string(word);
    begun = true;
  }
  return text + line + "\n";
}

}  // namespace pairsum::harness
