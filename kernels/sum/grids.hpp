#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include <pairsum/grid/grid.hpp>
#include <pairsum/grid/hashed_grid.hpp>
#include <pairsum/sum/omega.hpp>

namespace pairsum {

/// Names of the grids, in the order they are listed.
std::vector<std::string_view> grid_names();

/// Does this grid fold cells, so that it needs an M? Setups of the others may have any. An unknown name is an error.
bool grid_takes_M(std::string_view grid);

/// The grid that `s` names; an error lists the valid names or says what is wrong with M, H or Omega.
template <int D, class R>
std::unique_ptr<grid<D, R>> make_grid(const setup& s);

/// Does the grid that `s` names fit the periodic box of `s`, in every precision?
bool grid_fits(const setup& s);

/// The setup, for cells that are wider by a skin, in units of H.
setup with_skin(setup s, double skin);

}  // namespace pairsum
