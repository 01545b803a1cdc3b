#include "harness/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cases/case.hpp"
#include "core/names.hpp"
#include "core/random.hpp"
#include "harness/environment/environment.hpp"
#include "integrators/integrator.hpp"
#include "sum/grids.hpp"
#include "sum/registry.hpp"

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

void check_request(const run_request& r, const registry& all) {
  std::vector<std::string_view> cases;
  for (const case_entry& c : case_entries()) cases.push_back(c.name);
  check_word("case", r.case_name, cases);
  for (const auto& s : r.states) check_word("state", s, case_states);
  for (const auto& b : r.backends) all.find_backend(b);
  check_word("interaction", r.interaction, all.interactions());
  check_word("smoothing kernel", r.smoothing, all.smoothings());
  check_word("precision", r.precision, all.precisions());
  std::vector<std::string> dims;
  for (const int d : all.dims()) dims.push_back(fmt::format("{}D", d));
  check_word("dimension", fmt::format("{}D", r.dim), dims);
  check_word("order", r.order, memory_orders);
  check_word("grid", r.grid, grid_names());
  check_word("value of --outside", r.outside, std::vector<std::string_view>{"error", "drop"});
  find_integrator(r.integrator);
  for (const double dx : r.dx) check_positive("dx", dx);
  if (r.H != 0) check_positive("H", r.H);
  check_positive("dt", r.dt);
  for (const int M : r.M) check_hash_size(r.dim, M);
  for (const int t : r.threads) {
    check_at_least("threads", t, 1);
    if (t > 4096) throw error(fmt::format("threads must be at most 4096, is {}", t));
  }
  check_at_least("steps", r.steps, 1);
  check_at_least("repetitions", r.repetitions, 1);
  check_at_least("budget", r.budget_s, 0);
  if (r.study.empty() || r.study.find_first_of("/\\ \t\n") != std::string::npos || r.study.front() == '.')
    throw error(
        fmt::format("a study's name is a folder's name: no slash, no blank, no leading dot, is \"{}\"", r.study));
}

std::vector<world_plan> expand(const run_request& r, const registry& all) {
  std::vector<world_plan> worlds;
  for (const double dx : r.dx)
    for (const std::string& state : r.states) {
      world_plan w{dx, state, {}};
      for (const int M : r.M)
        for (const int threads : r.threads)
          for (const std::string& backend : r.backends) {
            point p;
            p.case_name = r.case_name;
            p.state = state;
            p.dx = dx;
            p.order = r.order;
            p.dim = r.dim;
            p.precision = r.precision;
            p.interaction = r.interaction;
            p.smoothing = r.smoothing;
            p.integrator = r.integrator;
            p.dt = r.dt;
            p.backend = backend;
            p.grid = r.grid;
            p.M = M;
            p.isa = compiled_isa();
            const bool serial = all.find_backend(backend).traits.threads == runtime::serial;
            p.threads = serial ? 1 : threads;
            if (std::ranges::find(w.points, p) == w.points.end()) w.points.push_back(p);
          }
      worlds.push_back(std::move(w));
    }
  return worlds;
}

std::vector<std::size_t> shuffled_order(std::size_t n, std::uint64_t seed, int repetition) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const counter_random random(seed, 1000 + static_cast<std::uint64_t>(repetition));
  for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[random.bits(k) % k]);  // Fisher-Yates
  return order;
}

}  // namespace pairsum::harness
