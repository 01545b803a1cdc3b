#include "harness/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/granularity.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/random.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/schedule/block_shape.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/plan/levels.hpp"
#include "harness/plan/variants.hpp"
#include "harness/plan/words.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/rows/fields.hpp"

namespace pairsum::harness {
namespace {

void check_at_least(const char* what, double value, double least) {
  if (!(value >= least) || !std::isfinite(value))
    throw error(fmt::format("{} must be at least {}, is {}", what, least, value));
}

void check_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw error(fmt::format("{} must be a positive number, is {}", what, value));
}

}  // namespace

std::vector<std::string_view> case_state_words() {
  std::vector<std::string_view> words = case_states;
  words.emplace_back("evolved:T");
  return words;
}

void check_request(const run_request& r, const registry& all) {
  std::vector<std::string_view> cases;
  for (const case_entry& c : case_entries()) cases.push_back(c.name);
  if (r.particles.empty()) {
    check_word("case", r.case_name, cases);
    for (const auto& s : r.states)
      if (!evolved_time(s)) check_word("state", s, case_state_words());
    if (!r.hints.empty())
      throw error(fmt::format("{} is about particles of files, of which --particles names none",
                              option_of(r.hints.begin()->first)));
  } else {
    for (const auto& s : r.states)
      check_word("state of particles of files", s, std::vector<std::string_view>{state_of_files, "perturbed"});
  }
  for (const auto& b : r.backends) all.find_backend(b);
  for (const auto& i : r.interactions) all.check_interaction(i);
  if (std::ranges::any_of(r.interactions, [&](const std::string& i) { return all.is_smoothed(i); }))
    for (const auto& k : r.smoothings) all.check_smoothing(k);
  for (const auto& p : r.precisions) all.check_precision(p);
  all.check_dim(r.dim);
  for (const auto& o : r.orders) check_word("order", o, memory_orders);
  for (const auto& i : r.integrators) find_integrator(i);
  for (const auto& g : r.grids) check_word("grid", g, grid_names());
  for (const auto& i : r.isas)
    if (i != default_isa) check_isa(i);
  for (const auto& b : r.blocks) check_block(b);
  check_word("value of --outside", r.outside, std::vector<std::string_view>{"error", "drop"});
  for (const double dx : r.dx) check_positive("dx", dx);
  if (r.H != 0) check_positive("H", r.H);
  check_positive("dt", r.dt);
  for (const int M : r.M) check_hash_size(r.dim, M);
  check_built(r, all);
  for (const int n : r.ranks) {
    check_at_least("ranks", n, 1);
    if (n > 65536) throw error(fmt::format("ranks must be at most 65536, is {}", n));
    if (const std::string why = why_no_ranks(); n > 1 && !why.empty()) throw unavailable(why);
  }
  for (const auto& c : r.cuts) check_word("cut", c, cut_words);
  for (const int t : r.shared_threads) check_at_least("threads of all ranks", t, 1);
  for (const int t : r.threads) {
    check_at_least("threads", t, 1);
    if (t > 4096) throw error(fmt::format("threads must be at most 4096, is {}", t));
  }
  check_at_least("steps", r.steps, 1);
  check_at_least("repetitions", r.repetitions, 1);
  for (const auto& g : r.granularities)
    if (g != default_granularity)
      for (const auto& b : r.backends) parse_granularity(g, all.find_backend(b).traits.threads);
  if (r.study.empty() || r.study.find_first_of("/\\ ") != std::string::npos || r.study.front() == '.' ||
      has_controls(r.study))
    throw error(
        fmt::format("a study's name is a folder's name: no slash, no blank, no leading dot, is \"{}\"", r.study));
}

namespace {

/// The granularity that a word means for a backend, as it appears in a row.
std::string granularity_of(const std::string& word, const backend_traits& b) {
  return name_of(word == default_granularity ? b.loop : parse_granularity(word, b.threads));
}

/// The numbers of threads of each of so many ranks.
std::vector<int> threads_of(const run_request& r, int ranks) {
  std::vector<int> threads = r.threads;
  for (const int all : r.shared_threads) threads.push_back(std::max(1, all / ranks));
  return threads;
}

/// The cut that a word means for a backend on so many ranks: what sums one side of each pair has nothing to send back.
std::string cut_of(const std::string& word, int ranks, const backend_traits& b) {
  return ranks == 1 ? std::string(no_cut) : b.symmetric ? word : std::string(cut_words[0]);
}

/// A number of ranks with the threads of each and the cut.
struct rank_way {
  int ranks, threads;
  std::string cut;
};

std::vector<rank_way> rank_ways(const run_request& r) {
  std::vector<rank_way> ways;
  for (const int ranks : r.ranks)
    for (const int threads : threads_of(r, ranks))
      for (const std::string& cut : r.cuts) ways.push_back({ranks, threads, cut});
  return ways;
}

/// The points of one world, whose words `p` holds.
world_plan points_of_world(point p, const run_request& r, const registry& all) {
  constexpr std::size_t most = 20000;
  world_plan points;
  std::set<std::string> there;
  const std::vector<backend_way> ways = ways_of(r, p, all);
  for (const std::string& integrator : r.integrators)
    for (const std::string& order : r.orders)
      for (const cell_grid& grid : grids_of(r))
        for (const auto& [ranks, threads, cut] : rank_ways(r))
          for (const auto& [backend, isa, block] : ways)
            for (const std::string& granularity : r.granularities) {
              const backend_traits& traits = all.find_backend(backend).traits;
              p.integrator = integrator;
              p.order = order;
              p.grid = grid.name;
              p.M = grid.M;
              p.backend = backend;
              p.isa = isa;
              p.block = block;
              p.threads = traits.threads == runtime::serial ? 1 : threads;
              p.ranks = ranks;
              p.cut = cut_of(cut, ranks, traits);
              p.granularity = granularity_of(granularity, traits);
              const std::string words =
                  fmt::format("{} {} {} {} {} {} {} {} {} {} {}", integrator, order, grid.name, grid.M, backend, isa,
                              block, p.threads, p.granularity, ranks, p.cut);
              if (there.insert(words).second) points.push_back(p);
              if (points.size() > most)
                throw error(fmt::format("the lists make more than {} points of {}; shorter ones make fewer", most,
                                        p.case_name));
            }
  return points;
}

}  // namespace

std::vector<world_plan> expand(const run_request& r, const registry& all) {
  std::vector<world_plan> worlds;
  point p;
  p.case_name = r.case_name;
  p.dim = r.dim;
  p.dt = r.dt;
  for (const double dx : r.dx)
    for (const std::string& state : r.states)
      for (const std::string& precision : r.precisions)
        for (const std::string& interaction : r.interactions)
          for (const std::string& smoothing : r.smoothings) {
            const bool smoothed = all.is_smoothed(interaction);
            if (!smoothed && smoothing != r.smoothings.front()) continue;
            p.dx = dx;
            p.state = state;
            p.precision = precision;
            p.interaction = interaction;
            p.smoothing = smoothed ? smoothing : no_smoothing;
            if (world_plan points = points_of_world(p, r, all); !points.empty()) worlds.push_back(std::move(points));
          }
  return worlds;
}

std::vector<std::size_t> shuffled_order(std::size_t n, std::uint64_t seed, int round, int repetition) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const counter_random random(
      seed, 1000 + (static_cast<std::uint64_t>(round) << 32) + static_cast<std::uint64_t>(repetition));
  for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[random.bits(k) % k]);  // Fisher-Yates
  return order;
}

}  // namespace pairsum::harness
