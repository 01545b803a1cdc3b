#include <pairsum/cases/case.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/random.hpp>

namespace pairsum {
namespace {

void check_length(const char* what, double a) {
  if (!(a > 0) || !std::isfinite(a))
    throw error(std::string(what) + " must be a positive length in m, is " + number_text(a));
}

/// Interleaves the low 21 bits of the components.
std::uint64_t morton_key(const std::array<std::uint64_t, 3>& c) {
  std::uint64_t key = 0;
  for (int bit = 20; bit >= 0; --bit)
    for (int d = 2; d >= 0; --d) key = key << 1 | (c[d] >> bit & 1);
  return key;
}

}  // namespace

initial_condition make_case(std::string_view name, const case_parameters& c) {
  std::vector<std::string_view> names;
  for (const case_entry& e : case_entries()) {
    names.push_back(e.name);
    if (e.name != name) continue;
    check_length("dx", c.dx);
    if (c.H != 0) check_length("H", c.H);
    if (std::ranges::find(case_states, c.state) == case_states.end()) throw unknown_name("state", c.state, case_states);
    initial_condition made = e.make(c);
    if (made.H == 0) made.H = c.H != 0 ? c.H : 2 * c.dx;
    if (c.state == "perturbed") perturb(made, c.dx, c.seed);
    return made;
  }
  throw unknown_name("case", name, names);
}

void perturb(initial_condition& c, double dx, std::uint64_t seed) {
  particle_table& p = c.particles;
  const double v_max = 0.1 * c.eos.sound_speed0();
  const counter_random jitter(seed, 1), velocity(seed, 2), density(seed, 3);
  box<3, double> omega;
  for (int d = 0; d < p.dim; ++d) omega.low[d] = c.omega_low[d], omega.high[d] = c.omega_high[d];
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    for (int d = 0; d < p.dim; ++d) {
      const std::uint64_t at = 3 * i + static_cast<std::uint64_t>(d);
      p.x[d][i] += dx * (-0.3 + jitter.uniform(at, -0.05, 0.05));
      if (c.periodic[d]) p.x[d][i] = omega.wrapped(d, p.x[d][i]);
      p.v[d][i] = velocity.uniform(at, -v_max, v_max);
    }
    p.rho[i] *= density.uniform(i, 0.99, 1.01);
  }
}

std::vector<std::uint32_t> memory_order(std::string_view name, const initial_condition& c, std::uint64_t seed) {
  const particle_table& p = c.particles;
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  if (name == "lattice") return order;
  std::vector<std::uint64_t> key(p.size());
  if (name == "shuffled") {
    const counter_random random(seed, 4);
    for (std::size_t i = 0; i < key.size(); ++i) key[i] = random.bits(i);
  } else if (name == "morton") {
    for (std::size_t i = 0; i < key.size(); ++i) {
      std::array<std::uint64_t, 3> cell{};
      for (int d = 0; d < p.dim; ++d)
        cell[d] = static_cast<std::uint64_t>(std::clamp((p.x[d][i] - c.omega_low[d]) / c.H, 0.0, 2097151.0));
      key[i] = morton_key(cell);
    }
  } else {
    throw unknown_name("order", name, memory_orders);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return key[i]; });
  return order;
}

}  // namespace pairsum
