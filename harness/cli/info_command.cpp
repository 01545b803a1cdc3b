// What is in files of particles, and what summing them will be like.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/profile_levels.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

struct info_options {
  std::vector<std::string> files;
  std::map<std::string, std::string> levels;
  bool json = false;
};

/// Pairs and cells of the particles, counted by summing them.
struct pair_counts {
  work_counts work;
  double cells_of_box = 0;  ///< as wide as H
  std::uint64_t pairs() const { return work.pairs_interacting(); }
};

/// Sums `count` on the first grid that holds the domain, then counts its work. The sum must agree.
pair_counts count_pairs(const initial_condition& c) {
  setup s = setup_of(c);
  s.backend = "symmetric_omp";
  s.interaction = "count";
  s.smoothing = no_smoothing;
  s.isa = "scalar";
  for (const char* const grid : {"compact_grid", "dense_grid", "hashed_grid"}) {
    s.grid = grid;
    if (grid_fits(s)) break;
  }
  const auto sum = registry::instance().make_summation(s);
  const workers threads(runtime::omp, usable_cores());
  sum->load(c.particles, {}, threads.get());
  sum->evaluate(threads.get());
  pair_counts counts;
  counts.work = sum->count_work();
  const rate_table rates = sum->rates();
  std::uint64_t neighbours = 0;
  for (const double n : rates.columns.at(0)) neighbours += static_cast<std::uint64_t>(n);
  if (neighbours != 2 * counts.work.pairs_fluid_fluid + counts.work.pairs_fluid_boundary)
    throw error(fmt::format("the sum met {} neighbours, but {} pairs were counted", neighbours, counts.pairs()));
  counts.cells_of_box = 1;
  for (std::size_t d = 0; d < c.omega_low.size(); ++d) {
    const double cells = (c.omega_high[d] - c.omega_low[d]) / c.H;
    counts.cells_of_box *= std::max(1.0, c.periodic[static_cast<int>(d)] ? std::floor(cells) : std::ceil(cells));
  }
  return counts;
}

nlohmann::json facts_json(const particles_of_request& set) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [what, value, how, from] : set.facts)
    if (!what.starts_with("--")) all.push_back({{"what", what}, {"value", value}, {"how", how}, {"from", from}});
  return all;
}

nlohmann::json info_json(const particles_of_request& set, const pair_counts& counts) {
  const initial_condition& c = set.initial;
  const std::size_t n = c.particles.size(), fluid = c.particles.count(particle_kind::fluid);
  return {{"particles", n},
          {"fluid", fluid},
          {"boundary", n - fluid},
          {"dim", c.particles.dim},
          {"pairs", counts.pairs()},
          {"pairs_fluid_fluid", counts.work.pairs_fluid_fluid},
          {"pairs_fluid_boundary", counts.work.pairs_fluid_boundary},
          {"pairs_tested", counts.work.pairs_tested},
          {"cells_nonempty", counts.work.cells_nonempty},
          {"H", c.H},
          {"dx", set.dx},
          {"box", {{"low", c.omega_low}, {"high", c.omega_high}}},
          {"periodic", c.periodic.text()},
          {"facts", facts_json(set)},
          {"hash", set.hash}};
}

std::string extents_text(const particle_table& p) {
  std::string text;
  for (const auto& x : p.x) {
    const auto [low, high] = std::ranges::minmax(x);
    text += fmt::format("{}{:.6g} to {:.6g}", text.empty() ? "" : ", ", low, high);
  }
  return text;
}

/// Which backends to expect in front, by the studies `density` and `field` (docs/results.md).
std::string expected(double pairs_per_particle) {
  constexpr double few = 3;
  return pairs_per_particle < few
             ? "expect verlet_list in front, which keeps a list of few pairs; pairsum tune measures it"
             : "expect tiles_tbb, tiles_omp, sliced_2colour_tbb, sliced_locks, task_conflicts on vector units "
               "in front; pairsum tune measures it";
}

std::string info_text(const particles_of_request& set, const pair_counts& counts) {
  const initial_condition& c = set.initial;
  const work_counts& w = counts.work;
  const auto n = static_cast<double>(c.particles.size()),
             fluid = static_cast<double>(c.particles.count(particle_kind::fluid));
  const double filled = static_cast<double>(w.cells_nonempty) / counts.cells_of_box;
  std::string text;
  const auto line = [&](const char* what, const std::string& value) { text += fmt::format("{:<20}{}\n", what, value); };
  line("extents", extents_text(c.particles));
  line("spacing", fmt::format("{:.6g}, H is {:.3g} of it", set.dx, c.H / set.dx));
  line("pairs", fmt::format("{} interact: {} fluid-fluid, {} fluid-boundary", counts.pairs(), w.pairs_fluid_fluid,
                            w.pairs_fluid_boundary));
  line("pairs per particle",
       fmt::format("{:.1f} of the fluid, each pair once", static_cast<double>(counts.pairs()) / fluid));
  line("cells", fmt::format("{} of {:.0f} hold particles, {:.1f} each", w.cells_nonempty, counts.cells_of_box,
                            n / static_cast<double>(w.cells_nonempty)));
  if (w.pairs_tested > 0)
    line("useful pairs", fmt::format("{:.1f} % of the distance tests hit", 100.0 * static_cast<double>(counts.pairs()) /
                                                                               static_cast<double>(w.pairs_tested)));
  line("backends", expected(static_cast<double>(counts.pairs()) / fluid));
  line("grid", filled > 0.5
                   ? fmt::format("{:.0f} % of the cells are filled: dense_grid looks at few empty ones", 100 * filled)
                   : fmt::format("{:.0f} % of the cells are filled: compact_grid and hashed_grid keep no empty ones",
                                 100 * filled));
  return text;
}

int info(const info_options& o, const given_options& given) {
  run_request r = levels_of(o.levels, "", given);
  for (const std::string& list : o.files)
    for (std::string& path : parse_words("info", list)) r.particles.push_back(std::move(path));
  r.H_in_spacings = 2;  // nothing is measured: an assumption that the table names will do
  const std::string table = take_particles(r);
  const particles_of_request set = initial_of(r, r.dx.front(), state_of_files);
  if (o.json) {
    fmt::print("{}\n", info_json(set, count_pairs(set.initial)).dump(1));
    return 0;
  }
  fmt::print("{}\n{}", table, info_text(set, count_pairs(set.initial)));
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, action& chosen) {
  CLI::App* const command =
      app.add_subcommand("info",
                         "Reads files of particles as one set and says what is in it, what was derived or assumed, and "
                         "what summing it is\n"
                         "like. PATH:boundary and PATH:fluid say what all particles of a file are.");
  const auto o = std::make_shared<info_options>();
  command
      ->add_option("files", o->files, "CSV, HDF5 (GADGET, SWIFT, PySPH, H5Part, SPH-EXA, VTKHDF), bi4 of DualSPHysics")
      ->required();
  command->add_option("--H", o->levels["H"],
                      "support radius in m, for all particles [what files say, else 2 spacings]");
  command->add_option("--dim", o->levels["file_dim"],
                      "dimension (default: a constant column of positions is left out)");
  add_particle_hints(*command, o->levels);
  command->add_flag("--json", o->json, "all of it as one JSON document");
  command->callback([&chosen, o, command] {
    const given_options given = given_of(*command);
    chosen = [o, given] { return info(*o, given); };
  });
}

}  // namespace pairsum::harness
