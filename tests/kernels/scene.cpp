#include "scene.hpp"

#include <cmath>
#include <sstream>

#include "sum/grids.hpp"

namespace pairsum::test_kit {

scene make_scene(std::string_view name, double dx, std::string_view state, std::uint64_t seed) {
  case_parameters parameters;
  parameters.dx = dx;
  parameters.state = state;
  parameters.seed = seed;
  initial_condition made = make_case(name, parameters);
  scene s;
  s.world.omega_low = made.omega_low;
  s.world.omega_high = made.omega_high;
  s.world.periodic = made.periodic;
  s.world.constants = {made.H, made.eos};
  s.particles = std::move(made.particles);
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

std::vector<formula> formulas() {
  std::vector<formula> all;
  for (const combination& c : registry::instance().formulas())
    all.push_back({c.dim, c.precision, c.interaction, c.smoothing.empty() ? "none" : c.smoothing});
  return all;
}

setup with(setup s, const formula& f, std::string_view backend, const grid_choice& grid) {
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

std::vector<std::string> backends_for(const formula& f) {
  std::vector<std::string> names = backend_names();
  if (f.precision == "mixed")
    std::erase_if(names, [](const auto& name) { return !registry::instance().find_backend(name).traits.vector; });
  return names;
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
