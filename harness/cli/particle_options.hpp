#pragma once
#include <string>
#include <vector>

#include <pairsum/files/particle_file.hpp>

namespace CLI {
class App;
}

namespace pairsum::harness {

/// What files of particles do not say, as words of the command line; empty words are not told.
struct particle_words {
  std::string H, h, support, h_quantile, rho0, mass, boundary_kind, periodic, box, dim, step;
  std::vector<std::string> columns;
};

/// Adds these options to a command, but those that it has already.
void add_particle_options(CLI::App& command, particle_words& words);

/// What the words say. Errors name the option.
files::hints hints_of(const particle_words& words);

/// "a.csv,b.csv:boundary" as paths.
std::vector<std::string> particle_paths(const std::string& list);

}  // namespace pairsum::harness
