#include "harness/cli/list_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <pairsum/core/names.hpp>
#include "harness/cli/list_words.hpp"

namespace pairsum::harness {
namespace {

/// The algorithm of a backend: its name without the runtime.
std::string_view algorithm_of(std::string_view name) {
  for (const std::string_view suffix : {"_omp", "_tbb"})
    if (name.ends_with(suffix)) name.remove_suffix(suffix.size());
  return name;
}

std::string families_text(const registry& r) {
  std::string text;
  for (const conflict_avoidance family :
       {conflict_avoidance::serial, conflict_avoidance::gather, conflict_avoidance::colours,
        conflict_avoidance::atomics, conflict_avoidance::copies, conflict_avoidance::locks,
        conflict_avoidance::tasks}) {
    std::vector<std::string_view> algorithms;
    for (const backend_entry& b : r.backends())
      if (const auto name = algorithm_of(b.traits.name);
          b.traits.conflicts == family && std::ranges::find(algorithms, name) == algorithms.end())
        algorithms.push_back(name);
    if (!algorithms.empty()) text += filled(fmt::format("  {:<9}", name_of(family)), join(algorithms), 11);
  }
  return text;
}

/// The words of a kind, and how many are not here.
std::string words_text(const std::vector<listed_word>& entries) {
  std::vector<std::string_view> words;
  for (const listed_word& e : entries)
    if (e.here) words.push_back(e.word);
  const std::size_t others = entries.size() - words.size();
  return join(words) + (others > 0 ? fmt::format(" ({} more in other builds)", others) : "");
}

/// The names of all plans, with a star at those that cannot be run as they are.
std::string starred_plans(const std::vector<listed_word>& plans) {
  std::vector<std::string> words;
  bool stars = false;
  for (const listed_word& plan : plans) {
    words.push_back(plan.word + (plan.here ? "" : "*"));
    stars = stars || !plan.here;
  }
  return join(words) + (stars ? " (*: in part)" : "");
}

std::string backends_text(const registry& r) {
  std::string text = fmt::format("{:<20} {:<8} {:<7} {}\n", "backend", "family", "runtime", "what it does");
  for (const backend_entry& b : r.backends()) {
    text += fmt::format("{:<20} {:<8} {:<7} {}\n", b.traits.name, name_of(b.traits.conflicts),
                        name_of(b.traits.threads), b.traits.description);
    if (!b.unavailable.empty()) text += fmt::format("{:<20} unavailable: {}\n", "", b.unavailable);
  }
  return text + "more of one: pairsum list backends NAME\n";
}

std::string plans_text() {
  constexpr std::size_t indent = 21;
  std::string text = fmt::format("{:<12} {:>6}  {}\n", "plan", "budget", "asks");
  bool all_run = true;
  for (const shipped_plan& shipped : shipped_plans()) {
    const study_plan plan = plan_named(shipped.name);
    text += filled(fmt::format("{:<12} {:>4.0f} s  ", shipped.name, plan.budget_s), plan.title, indent);
    for (const std::string& why : obstacles(plan)) {
      text += filled(std::string(indent, ' ') + "not as it is: ", why, indent);
      all_run = false;
    }
  }
  if (!all_run) text += "what is left of such a plan: pairsum run NAME --dry-run\n";
  return text;
}

}  // namespace

std::string overview_text(const registry& r) {
  std::string text = fmt::format("{} backends, by how they keep threads apart (names without _omp and _tbb)\n{}",
                                 r.backends().size(), families_text(r));
  for (const kind_of_word& kind : kinds()) {
    if (std::string_view(kind.name) == "backends") continue;
    const std::vector<listed_word> entries = entries_of(kind, r);
    const bool plans = std::string_view(kind.name) == "plans";
    const auto here = std::ranges::count(entries, true, &listed_word::here);
    const std::string head = fmt::format("{:<12} {:>3}  ", kind.name, plans ? std::ssize(entries) : here);
    text += filled(head, plans ? starred_plans(entries) : words_text(entries), head.size());
  }
  return text + "next: pairsum list backends NAME, run PLAN --dry-run, tune --help\n";
}

std::string kind_text(const std::string& kind, const registry& r) {
  std::vector<std::string_view> names;
  for (const kind_of_word& k : kinds()) names.emplace_back(k.name);
  for (const kind_of_word& k : kinds())
    for (const listed_word& e : entries_of(k, r))
      if (e.word == kind && std::ranges::find(names, kind) == names.end())
        throw error(fmt::format("\"{}\" is one of the {}: pairsum list {}{}", kind, k.name, k.name,
                                std::string_view(k.name) == "backends" ? " " + kind : ""));
  check_word("kind", kind, names);
  if (kind == "backends") return backends_text(r);
  if (kind == "plans") return plans_text();
  std::string text;
  for (const kind_of_word& k : kinds())
    if (k.name == kind)
      for (const listed_word& e : entries_of(k, r))
        text += e.text.empty() ? e.word + "\n" : fmt::format("{:<20} {}\n", e.word, e.text);
  return text;
}

}  // namespace pairsum::harness
