#include "scene.hpp"

#include <cmath>
#include <sstream>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/random.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/setup_of.hpp>

namespace pairsum::test_kit {

scene make_scene(std::string_view name, double dx, std::string_view state, std::uint64_t seed) {
  initial_condition made = make_case(name, {.dx = dx, .state = std::string(state), .seed = seed});
  return {std::move(made.particles), setup_of(made)};
}

scene make_scene_in(int dim, std::string_view name, double dx, std::string_view state) {
  initial_condition made = make_case(name, {.dim = dim, .dx = dx, .state = std::string(state)});
  scene s{std::move(made.particles), setup_of(made)};
  s.world.grid = "compact_grid";
  return s;
}

scene crowded_cell() {
  scene s;
  const double H = s.world.constants.H = 0.1;
  s.world.omega_low = {0, 0, 0};
  s.world.omega_high = {1, 1, 1};
  const counter_random random(3);
  const std::uint32_t few = 10, fluid = 2100, n = 6400;
  s.particles.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    // The first few are in reach of the boundary, the other fluid is not.
    const double left = i < few ? 0.45 : i < fluid ? 0.55 : 0;
    for (std::uint32_t d = 0; d < 3; ++d) {
      s.particles.x[d][i] = 0.41 + H * ((d == 0 ? left : 0) + 0.04 * random.uniform(3 * i + d));
      s.particles.v[d][i] = random.uniform(3 * i + d + 100000, -1, 1);
    }
    s.particles.rho[i] = 1000 + i % 7;
    s.particles.m[i] = 1e-3 * (1 + i % 3);
    s.particles.kind[i] = i < fluid ? particle_kind::fluid : particle_kind::boundary;
  }
  return s;
}

std::vector<grid_choice> every_grid(const std::vector<int>& all_M) {
  std::vector<grid_choice> all(all_M.begin(), all_M.end());
  for (const std::string_view name : grid_names())
    if (!grid_takes_M(name)) all.emplace_back(name, 0);
  return all;
}

setup with(setup s, std::string_view backend, const grid_choice& grid, std::string_view interaction) {
  s.backend = backend;
  s.grid = grid.name;
  s.M = grid.M;
  s.interaction = interaction;
  return s;
}

std::vector<formula_choice> formulas() {
  std::vector<formula_choice> all;
  for (const combination& c : registry::instance().formulas())
    all.push_back({c.dim, c.precision, c.interaction, c.smoothing.empty() ? "none" : c.smoothing});
  return all;
}

setup with(setup s, const formula_choice& f, std::string_view backend, const grid_choice& grid) {
  s.precision = f.precision;
  s.smoothing = f.smoothing;
  return with(s, backend, grid, f.interaction);
}

std::vector<std::string> backend_names() {
  std::vector<std::string> names;
  for (const backend_entry& b : registry::instance().backends())
    if (b.unavailable.empty()) names.emplace_back(b.traits.name);
  return names;
}

std::vector<std::string> backends_for(const formula_choice& f) {
  std::vector<std::string> names = backend_names();
  if (f.precision == "mixed") std::erase(names, "atomic_add");
  return names;
}

std::vector<std::string> isas_for(const formula_choice& f, const std::string& backend) {
  std::vector<std::string> all;
  if (f.precision != "mixed") all.emplace_back(scalar_isa);
  if (f.interaction != "count" && backend != "atomic_add")
    for (const std::string_view isa : isa_names()) all.emplace_back(isa);
  return all;
}

std::unique_ptr<summation> evaluated(const setup& s, const particle_table& p, int threads) {
  auto sum = registry::instance().make_summation(s);
  workers w(sum->traits().threads, threads);
  sum->load(p, {});
  sum->evaluate(w.get());
  return sum;
}

std::string disagreement(const rate_table& rates, const expectation& e, bool complete) {
  std::ostringstream text;
  text.precision(17);
  if (rates.names != e.names || rates.columns.size() != e.value.size()) return "other columns";
  for (std::size_t c = 0; c < e.value.size(); ++c) {
    std::vector<bool> seen(rates.columns[c].size(), false);
    for (std::size_t k = 0; k < e.ids.size(); ++k) {
      const double rate = rates.columns[c].at(e.ids[k]);
      seen[e.ids[k]] = true;
      if (std::isfinite(e.bound[c][k]) && std::abs(rate - e.value[c][k]) <= e.bound[c][k]) continue;
      text << rates.names[c] << " of particle " << e.ids[k] << " is " << rate << ", not " << e.value[c][k] << " +- "
           << e.bound[c][k];
      return text.str();
    }
    if (!complete) continue;
    for (std::uint32_t i = 0; i < rates.columns[c].size(); ++i)
      if (rates.columns[c][i] != 0 && !seen[i]) {
        text << rates.names[c] << " of particle " << i << " is " << rates.columns[c][i] << ", not 0";
        return text.str();
      }
  }
  return "";
}

bool says(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& w : words)
    if (text.find(w) == std::string::npos) return false;
  return true;
}

}  // namespace pairsum::test_kit
