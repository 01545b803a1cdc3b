#include "harness/plan/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/isa.hpp"
#include "core/names.hpp"
#include "core/precision.hpp"
#include "harness/environment/environment.hpp"
#include "sum/grids.hpp"

namespace pairsum::harness {
namespace {

template <class T>
void add_once(std::vector<T>& all, T one) {
  if (std::ranges::find(all, one) == all.end()) all.push_back(std::move(one));
}

/// The isa that a word means for a backend, as it stands in a row.
std::string isa_of(const std::string& word, const backend_traits& b) {
  if (!b.vector) return compiled_isa();
  if (word != "best") return word;
  const auto names = isa_names();
  return names.empty() ? word : std::string(names.front());
}

/// Can the backend sum the world at all? Asked with a tiny world, so that no wrong size speaks for it.
bool is_built(const std::string& backend, int dim, const point& world, const registry& all) {
  setup s;
  s.backend = backend;
  s.interaction = world.interaction;
  s.smoothing = world.smoothing;
  s.precision = world.precision;
  s.dim = dim;
  s.M = 2;
  s.constants.H = 0.1;
  s.omega_low.assign(static_cast<std::size_t>(dim), 0.0);
  s.omega_high.assign(static_cast<std::size_t>(dim), 1.0);
  try {
    all.make_summation(s);
  } catch (const error&) {
    return false;
  }
  return true;
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
        if (!built_backends(r, world, all).empty()) return true;
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

/// Why nothing that a request asks for is built.
std::string reason_of(const run_request& r, const registry& all) {
  run_request other = r;
  other.smoothings = all.smoothings();
  if (has_smoothed(r, all) && is_any_built(other, all))
    return "; with other smoothing kernels it is, configure with -DPAIRSUM_FORMULAS=all";
  return r.precisions == std::vector{std::string(mixed_precision)}
             ? ", which is for interactions of real numbers on vector units"
             : "";
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

std::vector<backend_way> ways_of(const run_request& r, const std::vector<std::string>& backends, const registry& all) {
  std::vector<backend_way> ways;
  for (const std::string& backend : backends) {
    const backend_traits& traits = all.find_backend(backend).traits;
    for (const std::string& isa : r.isas)
      for (const std::string& block : r.blocks)
        add_once(ways, backend_way{backend, isa_of(isa, traits), traits.blocks ? block : std::string(no_block)});
  }
  return ways;
}

std::vector<std::string> built_backends(const run_request& r, const point& world, const registry& all) {
  std::vector<std::string> built;
  for (const std::string& backend : r.backends) all.find_backend(backend);
  for (const std::string& backend : r.backends)
    if (is_built(backend, r.dim, world, all)) add_once(built, backend);
  return built;
}

void leave_out_unbuilt(run_request& r, std::vector<std::string> run_request::*words, const registry& all) {
  std::vector<std::string> built;
  for (const std::string& word : r.*words)
    if (is_any_built(with_one(r, words, word, all), all)) built.push_back(word);
  if (!built.empty()) r.*words = built;
}

void check_built(const run_request& r, const registry& all) {
  for (const auto words : {&run_request::precisions, &run_request::interactions, &run_request::smoothings})
    for (const std::string& word : r.*words) {
      const run_request one = with_one(r, words, word, all);
      if (!is_any_built(one, all))
        throw error(fmt::format("none of the backends {} is built for {}{} in {}D and precision {}{}", join(r.backends),
                                join(one.interactions),
                                has_smoothed(one, all) ? " with " + join(one.smoothings) : std::string(), r.dim,
                                join(one.precisions), reason_of(one, all)));
    }
}

}  // namespace pairsum::harness
