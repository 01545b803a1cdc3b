#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/registry.hpp>

/// What the tests of the library share: small worlds, teams, and the comparison of rates with an
/// expectation.
namespace pairsum::test_kit {

/// Particles and the setup of the world they live in.
struct scene {
  particle_table particles;
  setup world;
};

/// A case as a scene; M is left at the setup's default.
scene make_scene(std::string_view name, double dx, std::string_view state, std::uint64_t seed = 1);

/// A grid, and the M of a grid that takes one; a number alone means the hashed grid with that M.
struct grid_choice {
  std::string name = "hashed_grid";
  int M = 0;
  grid_choice(int m) : M(m) {}  // NOLINT: an M is a choice
  grid_choice(std::string_view grid, int m) : name(grid), M(m) {}
};
inline std::ostream& operator<<(std::ostream& o, const grid_choice& g) {
  return g.M > 0 ? o << g.name << " M=" << g.M : o << g.name;
}

/// The hashed grid with each of these M, and every grid that takes none.
std::vector<grid_choice> every_grid(const std::vector<int>& all_M);
/// A test's parameters: a backend and a grid; their name as a test's.
using backend_on_grid = std::tuple<std::string, grid_choice>;
inline std::string name_of_test(const testing::TestParamInfo<backend_on_grid>& i) {
  const grid_choice& g = std::get<1>(i.param);
  return std::get<0>(i.param) + "_" + g.name + (g.M > 0 ? "_M" + std::to_string(g.M) : "");
}

/// The grids that take no M.
inline std::vector<grid_choice> grids_without_M() { return every_grid({}); }

/// The scene with other words in its setup.
setup with(setup s, std::string_view backend, const grid_choice& grid, std::string_view interaction = "ferrari09");

/// What there is to sum, in one dimension and precision.
struct formula_choice {
  int dim;
  std::string precision, interaction, smoothing;  ///< smoothing is "none" where the interaction takes none
};
inline std::ostream& operator<<(std::ostream& o, const formula_choice& f) {
  return o << f.interaction << "_" << f.smoothing << "_" << f.dim << "D_" << f.precision;
}

/// Every formula of this build.
std::vector<formula_choice> formulas();
/// Those of its backends that take a formula.
std::vector<std::string> backends_for(const formula_choice& f);
/// On what a backend can sum a formula here: `scalar`, and the instruction sets of this build that this machine runs.
std::vector<std::string> isas_for(const formula_choice& f, const std::string& backend);
/// Backends that call, of a formula's functions: own, both plain, atomic and split, both of listed rows, those of half
/// stencils and of full ones.
inline const std::vector<std::string> callers{"naive_omp",     "symmetric_omp", "atomic_add",     "touched_blocks",
                                              "pair_list_omp", "tiles_omp",     "naive_tiles_omp"};
/// The talk's formula, and `count`.
inline const std::vector<formula_choice> two_formulas{{3, "double", "ferrari09", "wendland_c2"},
                                                      {3, "double", "count", "none"}};

/// The case in another dimension, on a grid that folds nothing.
scene make_scene_in(int dim, std::string_view name, double dx, std::string_view state);

/// A cell with so many particles that lists are full: one has more partners than is kept room for, 6144 in all, or, as
/// vector units take listed ones, 2048 of fluid.
scene crowded_cell();

/// The setup with a formula's words.
setup with(setup s, const formula_choice& f, std::string_view backend = "naive", const grid_choice& grid = 4);

using pairsum::workers;

/// The names of all backends, unavailable ones left out.
std::vector<std::string> backend_names();

/// A summation that has been loaded and evaluated once.
std::unique_ptr<summation> evaluated(const setup& s, const particle_table& p, int threads = 1);

/// How the rates differ from what the reference says: "" if every entry is within its bound, else
/// the first one that is not. Rows the reference did not evaluate must be 0 if it evaluated all
/// fluid (`complete`).
std::string disagreement(const rate_table& rates, const expectation& e, bool complete = true);

/// An OpenMP team for the references.
inline team some_threads() { return team::omp(2); }

/// The message of the pairsum::error that f throws, or "" if it throws none.
template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (const pairsum::error& e) {
    return e.what();
  }
  return "";
}

/// Does `text` contain all of `words`?
bool says(const std::string& text, const std::vector<std::string>& words);

}  // namespace pairsum::test_kit
