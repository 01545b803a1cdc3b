#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include <pairsum/core/names.hpp>
#include "harness/report/answer.hpp"
#include "harness/report/ladders.hpp"
#include "harness/report/self_tests.hpp"
#include "harness/report/text_table.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// The entries of a table that belong to one series, without those of self-test backends.
std::vector<json> of_series(const json& summary, const char* table, std::size_t series) {
  std::vector<json> found;
  for (const json& e : summary.at(table)) {
    const json& place = e.contains("point") ? e.at("point") : e;
    if (e.at("series") == series && !is_self_test(place.value("backend", ""))) found.push_back(e);
  }
  return found;
}

int most_threads(const std::vector<json>& entries) {
  int most = 0;
  for (const json& e : entries) most = std::max(most, e.at("threads").get<int>());
  return most;
}

std::string word(const json& value) { return value.get<std::string>(); }

std::string runtime_word(const json& e) {
  const std::string r = word(e.at("runtime"));
  return r == "omp" ? "OpenMP" : r == "tbb" ? "oneTBB" : "serial";
}

std::string with_bounds(const json& e, const char* key) {
  const double value = e.at(key);
  if (e.at("low").is_null()) return fmt::format("{:.2f} (no interval)", value);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", value, e.at("low").get<double>(), e.at("high").get<double>());
}

/// "1.50 to 2.00", or one figure if there is but one.
std::string range_of(double least, double most) {
  const std::string from = fmt::format("{:.2f}", least), to = fmt::format("{:.2f}", most);
  return from == to ? from : from + " to " + to;
}

std::string threads_text(int n) { return fmt::format("{} thread{}", n, n == 1 ? "" : "s"); }

/// "M = 6", or "on compact_grid" where the grid takes no M.
std::string cells(const json& place, const char* key = "M") {
  return place.at(key).is_null() ? "on " + word(place.at("grid")) : "M = " + place.at(key).dump();
}

/// A backend's name without its runtime.
std::string algorithm_of(const json& e, const char* key) {
  const std::string name = word(e.at(key)), runtime = "_" + word(e.at("runtime"));
  return name.ends_with(runtime) ? name.substr(0, name.size() - runtime.size()) : name;
}

/// What tells entries of a backend apart, or of backends with blocks: ", avx2, slab:4", of which only what is not the
/// same in all.
std::string variant(const json& e, const std::vector<json>& all) {
  const auto differs = [&](const char* key, auto&& is_like) {
    return std::ranges::any_of(all, [&](const json& o) { return is_like(o) && o.at(key) != e.at(key); });
  };
  std::string text;
  if (differs("isa", [&](const json& o) { return o.at("backend") == e.at("backend"); }))
    text += ", " + word(e.at("isa"));
  const bool has_blocks = e.at("block") != "none";
  if (has_blocks && differs("block", [](const json& o) { return o.at("block") != "none"; }))
    text += ", " + word(e.at("block"));
  return text;
}

/// Is the symmetric sum twice as fast? By the entries at equal M and the talk's second definition, on the most threads.
void ask_twice(const json& summary, std::size_t series, json& out) {
  std::vector<json> entries = of_series(summary, "algorithm_speedup", series);
  const int threads = most_threads(entries);
  std::erase_if(entries, [&](const json& e) { return e.at("threads") != threads; });
  if (entries.empty()) return;
  double least = 1e300, most = 0;
  std::vector<std::string> texts;
  for (const json& e : entries) {
    least = std::min(least, e.at("speedup").get<double>());
    most = std::max(most, e.at("speedup").get<double>());
    texts.push_back(fmt::format("{} {} {} over {} {}{}: {}", runtime_word(e), algorithm_of(e, "base_backend"),
                                cells(e, "base_M"), algorithm_of(e, "backend"), cells(e), variant(e, entries),
                                with_bounds(e, "speedup")));
  }
  const auto reaches = [](const json& e, double goal) {  // within its interval, if it has one
    return (e.at("high").is_number() ? e.at("high") : e.at("speedup")).get<double>() >= goal;
  };
  const bool yes = std::ranges::all_of(entries, [&](const json& e) { return reaches(e, 2); });
  const bool faster = std::ranges::any_of(entries, [&](const json& e) { return reaches(e, 1.0 + 1e-9); });
  const std::string verdict = yes       ? "Yes"
                              : !faster ? "No, it is not faster"
                                        : fmt::format("No, {} times", range_of(least, most));
  out.push_back(
      {{"question", "Is the symmetric sum twice as fast here?"},
       {"answer", fmt::format("{}, on {}: {}. Each pair is computed once instead of twice, but its distance is "
                              "tested and both particles are written{}.",
                              verdict, threads_text(threads), join(texts),
                              yes ? "" : ", so half the evaluations is not half the time")}});
}

/// Values with what to say of each: of all, or, where they are too many to read, of the least and of the greatest.
using said_values = std::vector<std::pair<double, std::string>>;
std::string spread(const said_values& all) {
  constexpr std::size_t readable = 8;
  if (all.size() > readable) {
    const auto [least, most] = std::ranges::minmax_element(all);
    return fmt::format("from {} to {}, {} others between", least->second, most->second, all.size() - 2);
  }
  std::vector<std::string> texts;
  for (const auto& [value, text] : all) texts.push_back(text);
  return join(texts);
}

/// Does it scale as well as the naive sum, and as the machine?
void ask_scaling(const json& summary, std::size_t series, json& out) {
  std::vector<json> entries = of_series(summary, "speedup", series);
  const int threads = most_threads(entries);
  std::erase_if(entries, [&](const json& e) { return e.at("threads") != threads; });
  if (entries.empty() || threads < 2) return;
  std::map<bool, std::vector<double>> by_kind;
  said_values speedups, shares;
  json machine = nullptr;
  std::vector<double> in_rounds;
  for (const json& e : entries) {
    const std::string backend = word(e.at("backend")), name = backend + " " + cells(e) + variant(e, entries);
    speedups.emplace_back(e.at("speedup"), fmt::format("{}: {}", name, with_bounds(e, "speedup")));
    if (const backend_traits* const t = traits_of(backend)) by_kind[t->symmetric].push_back(e.at("speedup"));
    machine = e.at("machine_flops_scaling");
    if (e.at("of_machine").at("value").is_null()) continue;
    in_rounds.push_back(e.at("machine_speedup").at("value"));
    const json& share = e.at("of_machine");
    shares.emplace_back(share.at("value"), fmt::format("{}: {}", name, with_bounds(share, "value")));
  }
  if (by_kind.size() < 2) return;
  const auto range = [](std::vector<double> v) {
    std::ranges::sort(v);
    return range_of(v.front(), v.back());
  };
  double waiting = 0;
  int waits = 0;
  for (const json& p : of_series(summary, "points", series))
    if (word(p.at("point").at("backend")).starts_with("symmetric_") && p.at("point").at("threads") == threads &&
        p.at("passes").is_object() && p.at("passes").at("wait_share").is_number()) {
      waiting += p.at("passes").at("wait_share").get<double>();
      ++waits;
    }
  std::string text = fmt::format("On {} gathers are {} times as fast as on one, symmetric sums {} times ({}).",
                                 threads_text(threads), range(by_kind[false]), range(by_kind[true]), spread(speedups));
  if (!in_rounds.empty())
    text += fmt::format(
        " In the same rounds the machine itself made {} times as many multiply-adds; of that the sums reach (medians "
        "over rounds; above 1 where the two were disturbed differently): {}.",
        range(in_rounds), spread(shares));
  else if (machine.is_number())
    text += fmt::format(" The machine itself does {:.2f} times as many multiply-adds.", machine.get<double>());
  if (waits > 0)
    text += fmt::format(" In the symmetric passes threads spend {:.1f} % of the time waiting at barriers.",
                        100 * waiting / waits);
  out.push_back({{"question", "Does it scale as well?"}, {"answer", text}});
}

/// "M = 7 (6.94 ms a step; M = 6 takes 1.09 times as long)", or which cannot be told apart.
std::string best_of(const std::map<int, json>& by_M) {
  const int best = by_M.begin()->second.at("best_M");
  std::vector<std::string> slower, tied;
  for (const auto& [M, e] : by_M) {
    if (M == best) continue;
    if (e.at("verdict") == "slower")
      slower.push_back(fmt::format("M = {} takes {:.2f} times as long", M, e.at("over_best").get<double>()));
    else
      tied.push_back(fmt::format("{}", M));
  }
  std::string text = fmt::format("M = {} ({} ms a step", best, ms(by_M.at(best).at("total_s")));
  if (!slower.empty()) text += "; " + join(slower);
  if (!tied.empty()) text += fmt::format("; no difference resolved from M = {}", join(tied));
  return text + ")";
}

/// What M does to the work: "M = 6: 19 % in 10284 cells".
std::string work_over_M(const std::map<int, json>& by_M) {
  std::vector<std::string> texts;
  for (const auto& [M, e] : by_M)
    if (e.at("cells_nonempty").is_number() && e.at("collision_share").is_number())
      texts.push_back(fmt::format("M = {}: {:.0f} % in {} cells", M, 100 * e.at("collision_share").get<double>(),
                                  e.at("cells_nonempty").get<std::uint64_t>()));
  return join(texts);
}

using over_M = std::map<int, json>;

/// For each backend its entries over M, at one grid and granularity and on as many threads as were measured with
/// several M.
std::map<std::string, over_M> entries_over_M(const json& summary, std::size_t series) {
  std::map<std::string, over_M> alike;
  for (const json& e : of_series(summary, "m_comparison", series))
    if (e.at("best_M").is_number())
      alike[json::array(
                {e.at("backend"), e.at("grid"), e.at("granularity"), e.at("isa"), e.at("block"), e.at("threads")})
                .dump()][e.at("M").get<int>()] = e;
  std::map<std::string, over_M> chosen;
  for (const auto& [key, by_M] : alike) {
    if (by_M.size() < 2) continue;
    over_M& best = chosen[word(by_M.begin()->second.at("backend"))];
    if (best.empty() || best.begin()->second.at("threads") < by_M.begin()->second.at("threads")) best = by_M;
  }
  return chosen;
}

/// Which M for which algorithm, and why.
void ask_M(const json& summary, std::size_t series, json& out) {
  std::vector<std::string> texts;
  std::map<bool, std::string> work;  // of the symmetric sums, of the gather
  for (const auto& [backend, by_M] : entries_over_M(summary, series)) {
    texts.push_back(backend + " " + best_of(by_M));
    if (backend.starts_with("naive") || backend.starts_with("symmetric"))
      work.try_emplace(backend.starts_with("symmetric"), work_over_M(by_M));
  }
  if (texts.empty()) return;
  std::string why;
  for (const auto& [symmetric, text] : work)
    if (!text.empty()) why += fmt::format(" {} {}.", symmetric ? "Of the symmetric sums:" : "Of the gather:", text);
  if (!why.empty()) why = " Share of the distance tests in vain, and cells with particles:" + why;
  out.push_back(
      {{"question", "Which M for which algorithm, and why?"},
       {"answer", fmt::format("{}. A smaller M folds more cells together, and distances are tested in vain. A "
                              "larger one costs nothing in the sweep, because only cells that hold particles "
                              "are visited; what it costs is in the index, whose table has 2^(dM) entries.{}",
                              join(texts), why)}});
}

void ask_runtime(const json& summary, std::size_t series, json& out) {
  const std::vector<json> entries = of_series(summary, "runtime_comparison", series);
  if (entries.empty()) return;
  int openmp = 0, tbb = 0, open = 0;
  double least = 1e300, most = 0;
  for (const json& e : entries) {
    const std::string verdict = word(e.at("verdict"));
    ++(verdict == "faster" ? tbb : verdict == "slower" ? openmp : open);
    least = std::min(least, e.at("ratio").get<double>());
    most = std::max(most, e.at("ratio").get<double>());
  }
  out.push_back(
      {{"question", "OpenMP or oneTBB?"},
       {"answer", fmt::format("Of {} comparisons oneTBB is faster in {}, OpenMP in {}, no difference is resolved "
                              "in {}; OpenMP's time is {:.3f} to {:.3f} of oneTBB's.",
                              entries.size(), tbb, openmp, open, least, most)}});
}

void ask_bound(const json& summary, std::size_t series, json& out) {
  json best;
  for (const json& p : of_series(summary, "points", series))
    if (p.at("model").is_object() &&
        (best.is_null() || p.at("model").at("share_of_bound") > best.at("model").at("share_of_bound")))
      best = p;
  if (best.is_null()) return;
  const json &model = best.at("model"), &p = best.at("point");
  out.push_back(
      {{"question", "How far is that from what the machine can do?"},
       {"answer",
        fmt::format("The nearest is {} {}{} and {}: {} could not be done in less than {} ms, and that "
                    "is {:.1f} % of the time it takes.",
                    word(p.at("backend")), p.at("M").is_null() ? "" : "with ", cells(p), threads_text(p.at("threads")),
                    model.at("limited_by") == "flops" ? "its arithmetic" : "its memory traffic",
                    ms(model.at("bound_s")), 100 * model.at("share_of_bound").get<double>())}});
}

}  // namespace

json questions(const json& summary) {
  json out = json::array();
  const json& answer = summary.at("answer");
  if (!answer.is_object()) return out;
  const std::size_t series = answer.at("series");
  ask_twice(summary, series, out);
  ask_scaling(summary, series, out);
  ask_M(summary, series, out);
  ask_runtime(summary, series, out);
  ask_bound(summary, series, out);
  return out;
}

}  // namespace pairsum::harness
