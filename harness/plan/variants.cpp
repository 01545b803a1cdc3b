#include "harness/plan/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/sum/grids.hpp>
#include "harness/environment/environment.hpp"
#include "harness/ranks/crew.hpp"

namespace pairsum::harness {
namespace {

template <class T>
void add_once(std::vector<T>& all, T one) {
  if (std::ranges::find(all, one) == all.end()) all.push_back(std::move(one));
}

/// The setup of a tiny domain, so that no check of sizes hides what is built.
setup tiny(const std::string& backend, const std::string& isa, int dim, const point& world) {
  setup s;
  s.backend = backend;
  s.isa = isa;
  s.interaction = world.interaction;
  s.smoothing = world.smoothing;
  s.precision = world.precision;
  s.dim = dim;
  s.M = 2;
  s.constants.H = 0.1;
  s.omega_low.assign(static_cast<std::size_t>(dim), 0.0);
  s.omega_high.assign(static_cast<std::size_t>(dim), 1.0);
  return s;
}

/// The isa that a word means for a backend in a world, as it appears in a row; none if it is unavailable, and then
/// why.
std::optional<std::string> isa_of(const std::string& backend, const std::string& word, int dim, const point& world,
                                  const registry& all, std::string* why = nullptr) {
  try {
    return std::string(all.make_summation(tiny(backend, word, dim, world))->isa());
  } catch (const error& e) {
    if (why != nullptr) *why = e.what();
    return std::nullopt;
  }
}

/// Is any of the request's backends built for any of its precisions, interactions and smoothing kernels?
bool is_any_built(const run_request& r, const registry& all) {
  point world;
  for (const std::string& precision : r.precisions)
    for (const std::string& interaction : r.interactions)
      for (const std::string& smoothing : r.smoothings) {
        world.precision = precision;
        world.interaction = interaction;
        world.smoothing = all.is_smoothed(interaction) ? smoothing : std::string(no_smoothing);
        if (!ways_of(r, world, all).empty()) return true;
      }
  return false;
}

bool has_smoothed(const run_request& r, const registry& all) {
  return std::ranges::any_of(r.interactions, [&](const std::string& i) { return all.is_smoothed(i); });
}

/// The request with one of its words alone; with one smoothing kernel, without the interactions that take none, unless
/// all are such.
run_request with_one(const run_request& r, std::vector<std::string> run_request::*words, const std::string& word,
                     const registry& all) {
  run_request one = r;
  one.*words = {word};
  if (words == &run_request::smoothings && has_smoothed(r, all))
    std::erase_if(one.interactions, [&](const std::string& i) { return !all.is_smoothed(i); });
  return one;
}

/// Why nothing that a request asks for is built: what the first of its backends says.
std::string reason_of(const run_request& r, const registry& all) {
  point world;
  world.precision = r.precisions.front();
  world.interaction = r.interactions.front();
  world.smoothing = has_smoothed(r, all) ? r.smoothings.front() : std::string(no_smoothing);
  std::string why;
  isa_of(r.backends.front(), r.isas.front(), r.dim, world, all, &why);
  return why.empty() ? "" : ": " + why;
}

/// The words that decide what must have been built.
constexpr std::vector<std::string> run_request::*built_words[]{&run_request::precisions, &run_request::interactions,
                                                               &run_request::smoothings};

void check_any_built(const run_request& one, const registry& all) {
  if (is_any_built(one, all)) return;
  throw unavailable(fmt::format("none of the backends {} is built for {}{} in {}D and precision {}{}",
                                join(one.backends), join(one.interactions),
                                has_smoothed(one, all) ? " with " + join(one.smoothings) : std::string(), one.dim,
                                join(one.precisions), reason_of(one, all)));
}

void check_backend_built(const run_request& r, const std::string& backend, const registry& all) {
  if (r.backends.size() == all.backends().size()) return;  // nobody asked for each by name
  run_request one = r;
  one.backends = {backend};
  if (!is_any_built(one, all))
    throw unavailable(
        fmt::format("backend {} is unavailable with isa {}{}", backend, join(r.isas), reason_of(one, all)));
}

}  // namespace

std::vector<cell_grid> grids_of(const run_request& r) {
  std::vector<cell_grid> all;
  for (const std::string& grid : r.grids)
    for (const int M : r.M) add_once(all, cell_grid{grid, grid_takes_M(grid) ? M : 0});
  return all;
}

std::vector<std::string> available_backends(const registry& all) {
  std::vector<std::string> names;
  for (const backend_entry& b : all.backends())
    if (b.unavailable.empty()) names.emplace_back(b.traits.name);
  return names;
}

std::vector<backend_way> ways_of(const run_request& r, const point& world, const registry& all) {
  std::vector<backend_way> ways;
  for (const std::string& backend : r.backends) {
    const backend_traits& traits = all.find_backend(backend).traits;
    for (const std::string& word : r.isas) {
      const auto isa = isa_of(backend, word, r.dim, world, all);
      if (!isa) continue;
      for (const std::string& block : r.blocks)
        add_once(ways, backend_way{backend, *isa, traits.blocks ? block : std::string(no_block)});
    }
  }
  return ways;
}

void leave_out_unbuilt(run_request& r, std::vector<std::string> run_request::*words, const registry& all) {
  std::vector<std::string> built;
  for (const std::string& word : r.*words)
    if (is_any_built(with_one(r, words, word, all), all)) built.push_back(word);
  if (!built.empty()) r.*words = built;
}

std::vector<std::string> leave_out_unavailable(run_request& r, const registry& all) {
  std::vector<std::string> why;
  const auto is_here = [&](const auto& check) {
    try {
      check();
      return true;
    } catch (const unavailable& e) {
      add_once(why, std::string(e.what()));
      return false;
    }
  };
  const auto keep = [&](std::vector<std::string>& words, const auto& check) {
    std::erase_if(words, [&](const std::string& word) { return !is_here([&] { check(word); }); });
    return !words.empty();
  };
  if (const std::string without = why_no_ranks();
      !without.empty() && std::erase_if(r.ranks, [](int n) { return n > 1; }) > 0)
    add_once(why, without);
  const bool here =
      !r.ranks.empty() && is_here([&] { all.check_dim(r.dim); }) &&
      keep(r.backends, [&](const std::string& b) { all.find_backend(b); }) &&
      keep(r.precisions, [&](const std::string& p) { all.check_precision(p); }) &&
      keep(r.interactions, [&](const std::string& i) { all.check_interaction(i); }) &&
      (!has_smoothed(r, all) || keep(r.smoothings, [&](const std::string& k) { all.check_smoothing(k); })) &&
      keep(r.isas, [&](const std::string& i) { i == default_isa ? void() : check_isa(i); }) &&
      std::ranges::all_of(built_words,
                          [&](const auto words) {
                            return keep(r.*words, [&](const std::string& word) {
                              check_any_built(with_one(r, words, word, all), all);
                            });
                          }) &&
      keep(r.backends, [&](const std::string& b) { check_backend_built(r, b, all); });
  if (!here) r.backends.clear();
  return why;
}

void check_built(const run_request& r, const registry& all) {
  for (const auto words : built_words)
    for (const std::string& word : r.*words) check_any_built(with_one(r, words, word, all), all);
  for (const std::string& backend : r.backends) check_backend_built(r, backend, all);
}

}  // namespace pairsum::harness
