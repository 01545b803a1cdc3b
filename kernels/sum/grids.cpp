#include <pairsum/sum/grids.hpp>

#include <cmath>
#include <limits>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/grid/compact_grid.hpp>
#include <pairsum/grid/dense_grid.hpp>
#include <pairsum/sum/check.hpp>

namespace pairsum {

std::vector<std::string_view> grid_names() {
  return {hashed_grid<3, double>::name, dense_grid<3, double>::name, compact_grid<3, double>::name};
}

bool grid_takes_M(std::string_view grid) {
  check_word("grid", grid, grid_names());
  return grid == hashed_grid<3, double>::name;
}

template <int D, class R>
std::unique_ptr<grid<D, R>> make_grid(const setup& s) {
  check_domain(s);
  const box<D, R> omega = make_box<D, R>(s);
  const R H = static_cast<R>(s.constants.H);
  if (s.grid == hashed_grid<D, R>::name) return std::make_unique<hashed_grid<D, R>>(omega, H, s.M);
  if (s.grid == dense_grid<D, R>::name) return std::make_unique<dense_grid<D, R>>(omega, H);
  if (s.grid == compact_grid<D, R>::name) return std::make_unique<compact_grid<D, R>>(omega, H);
  throw unknown_name("grid", s.grid, grid_names());
}

bool grid_fits(const setup& s) {
  try {
    for (const bool single : {false, true})
      at_place(s.dim, single, [&]<int D, class R>() { return make_grid<D, R>(s) != nullptr; });
  } catch (const error&) {
    return false;
  }
  return true;
}

setup with_skin(setup s, double skin) {
  s.constants.H *= 1 + skin;
  return s;
}

template <class R>
box<1, R> make_box_of_axis(const setup& s, std::size_t d) {
  box<1, R> b;
  b.periodic.on[0] = s.periodic.on.at(d);
  const R far = std::numeric_limits<R>::infinity();
  const double low = s.omega_low.at(d), high = s.omega_high.at(d);
  b.low[0] = static_cast<R>(low);
  b.high[0] = static_cast<R>(high);
  if (static_cast<double>(b.low[0]) > low) b.low[0] = std::nextafter(b.low[0], -far);
  if (static_cast<double>(b.high[0]) < high) b.high[0] = std::nextafter(b.high[0], far);
  return b;
}
template box<1, double> make_box_of_axis(const setup&, std::size_t);
template box<1, float> make_box_of_axis(const setup&, std::size_t);

template <int D, class R>
box<D, R> make_box(const setup& s) {
  box<D, R> b;
  b.periodic = s.periodic;
  for (int d = 0; d < D; ++d) {
    const box<1, R> axis = make_box_of_axis<R>(s, static_cast<std::size_t>(d));
    b.low[d] = axis.low[0];
    b.high[d] = axis.high[0];
  }
  return b;
}

#define PAIRSUM_GRIDS(D, R)                                           \
  template std::unique_ptr<grid<D, R>> make_grid<D, R>(const setup&); \
  template box<D, R> make_box<D, R>(const setup&);
PAIRSUM_EACH_D_R(PAIRSUM_GRIDS)

}  // namespace pairsum
