#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/core/axes.hpp>
#include <pairsum/eos/tait.hpp>
#include <pairsum/particles/particle_table.hpp>

namespace pairsum {

/// What a case is made from.
struct case_parameters {
  int dim = 3;
  double dx = 0;               ///< particle spacing, m
  double H = 0;                ///< support radius, m; 0 means 2 dx
  std::string state = "rest";  ///< "rest" or "perturbed"
  std::uint64_t seed = 1;      ///< of the perturbation and of random places
};

/// Particles with the domain they lie in. SI units.
struct initial_condition {
  particle_table particles;
  std::vector<double> omega_low, omega_high;  ///< m
  axes periodic = {};
  double H = 0;           ///< m
  double gravity = 9.81;  ///< m/s2, along -y (along -x in 1D)
  tait eos;
};

/// What a run with its reference takes per particle, roughly: tables of the case and of the reference, columns,
/// scratch.
inline constexpr double bytes_per_particle = 500;

/// A case: its name, what it is, and how to make it.
struct case_entry {
  std::string_view name, description;
  initial_condition (*make)(const case_parameters&);
  int least_dim = 1;  ///< it exists from this dimension up to 3

  template <class Case>
  static case_entry of() {
    int least_dim = 1;
    if constexpr (requires { Case::least_dim; }) least_dim = Case::least_dim;
    return {Case::name, Case::description, &Case::make, least_dim};
  }
};

/// All cases, in the order of kernels/registry.def.
const std::vector<case_entry>& case_entries();

/// The case of that name, perturbed if the parameters say so. Errors: unknown names (lists the valid ones), dx or H not
/// positive, a dimension the case does not have, more than 2^32 - 2 particles.
initial_condition make_case(std::string_view name, const case_parameters& c);

/// The states a case can be in.
inline const std::vector<std::string_view> case_states{"rest", "perturbed"};

/// Disturbs the fluid so that every term of a formula is alive: shift of -0.3 dx per axis (towards the walls), jitter
/// of +-0.05 dx, velocity in +-0.1 c0 per component, density times 1 +- 0.01, all uniform and by particle id.
void perturb(initial_condition& c, double dx, std::uint64_t seed);

/// Orders of memory: "lattice" (as made), "shuffled", "morton" (along the Z-curve of cells of width H). order[k] is the
/// id at k.
inline const std::vector<std::string_view> memory_orders{"lattice", "shuffled", "morton"};
std::vector<std::uint32_t> memory_order(std::string_view name, const initial_condition& c, std::uint64_t seed);

}  // namespace pairsum

/// Makes the struct `word` a case that kernels/registry.def may name.
#define PAIRSUM_CASE(word)                                      \
  namespace pairsum::cases_of {                                 \
  case_entry word() { return case_entry::of<pairsum::word>(); } \
  }
