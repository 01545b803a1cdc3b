#include "harness/cli/particle_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include <pairsum/core/error.hpp>
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

struct particle_option {
  const char* name;
  std::string particle_words::*word;
  const char* what;
};

constexpr particle_option particle_option_table[] = {
    {"--H", &particle_words::H, "support radius in m, for all particles"},
    {"--h", &particle_words::h, "smoothing length in m, for all particles; H = support x h"},
    {"--support", &particle_words::support, "H over h of the smoothing kernel that the file was made with"},
    {"--h-quantile", &particle_words::h_quantile,
     "of a varying h, which H is made of: 0.5 is the median (default: the largest)"},
    {"--rho0", &particle_words::rho0, "reference density in kg/m3"},
    {"--mass", &particle_words::mass, "mass of every particle in kg"},
    {"--boundary-kind", &particle_words::boundary_kind,
     "which particles are boundary: a column and its values, Type=0,1; groups, PartType=1 or name=wall; none"},
    {"--periodic", &particle_words::periodic, "periodic axes of the file: x,z, all or none"},
    {"--box", &particle_words::box, "edges of a box at 0, or its low and its high corner, in m: 0,0,0,1,1,2"},
    {"--dim", &particle_words::dim, "dimension (default: a constant column of positions is left out)"},
    {"--step", &particle_words::step, "of a file with several (default: the last)"},
};

std::optional<double> number_of(const char* option, const std::string& text) {
  if (text.empty()) return {};
  const std::vector<double> numbers = parse_numbers(option, text);
  if (numbers.size() != 1) throw error(fmt::format("{} is \"{}\", should be one number", option, text));
  return numbers.front();
}

}  // namespace

void add_particle_options(CLI::App& command, particle_words& words) {
  for (const particle_option& o : particle_option_table)
    if (command.get_option_no_throw(o.name) == nullptr) command.add_option(o.name, words.*o.word, o.what);
  command.add_option("--column", words.columns,
                     "what a column is called: x=Points:0, of x, y, z, vx, vy, vz, rho, m, h, kind; several times");
}

files::hints hints_of(const particle_words& words) {
  files::hints told;
  told.H = number_of("--H", words.H);
  told.h = number_of("--h", words.h);
  told.support = number_of("--support", words.support);
  told.h_quantile = number_of("--h-quantile", words.h_quantile);
  told.rho0 = number_of("--rho0", words.rho0);
  told.mass = number_of("--mass", words.mass);
  told.boundary_kind = words.boundary_kind;
  if (!words.periodic.empty()) told.periodic = words.periodic;
  if (!words.box.empty()) told.box = parse_numbers("--box", words.box);
  if (!words.dim.empty()) {
    if (words.dim != "1" && words.dim != "2" && words.dim != "3")
      throw error(fmt::format("--dim is \"{}\", should be 1, 2 or 3", words.dim));
    told.dim = words.dim[0] - '0';
  }
  if (!words.step.empty()) told.step = static_cast<std::int64_t>(parse_seed("--step", words.step));
  for (const std::string& c : words.columns) {
    const std::size_t equals = c.find('=');
    const std::string quantity = c.substr(0, equals);
    static const std::vector<std::string> valid{"x", "y", "z", "vx", "vy", "vz", "rho", "m", "h", "kind"};
    if (equals == c.npos || equals + 1 == c.size() || std::ranges::find(valid, quantity) == valid.end())
      throw error(
          fmt::format("--column is \"{}\", should be QUANTITY=NAME; quantities: {}", c, fmt::join(valid, ", ")));
    told.columns[quantity] = c.substr(equals + 1);
  }
  return told;
}

std::vector<std::string> particle_paths(const std::string& list) { return parse_words("the files", list); }

}  // namespace pairsum::harness
