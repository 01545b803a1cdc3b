#include <gtest/gtest.h>

#include <limits>

#include "periodic_box.hpp"

// Particles where a periodic box errs first: on its faces, edges and corners, on the faces of its cells, and one ulp to
// either side of each. No pair may be missed or summed twice, in the smallest box as in others.
namespace pairsum {
namespace {

using namespace test_kit;

struct box_kind {
  int dim;
  std::string precision;
  double H;
  std::vector<double> reaches;  ///< edges in units of H
  axes periodic;
  /// Do 3 or 4 cells fit along an axis only if they are exactly H wide?
  bool tight() const {
    bool is = false;
    for (std::size_t d = 0; d < 3; ++d) is = is || (periodic.on[d] && (reaches[d] == 3 || reaches[d] == 4));
    return is;
  }
};
std::ostream& operator<<(std::ostream& o, const box_kind& k) {
  return o << k.dim << "D_" << k.precision << "_H" << k.H << "_edge" << k.reaches[0] << "_periodic_"
           << k.periodic.text();
}

std::vector<box_kind> box_kinds() {
  const std::vector<std::vector<double>> boxes{{3, 3, 3},          {3.05, 3.5, 3.9}, {3, 8, 6},  {4, 4, 4},
                                               {4.05, 4.05, 4.05}, {8, 4.3, 4},      {6, 10, 4}, {16, 8.5, 5}};
  std::vector<box_kind> all;
  for (const int dim : registry::instance().dims())
    for (const std::string& precision : registry::instance().precisions())
      for (const double H : {0.125, 0.1})
        for (const std::vector<double>& reaches : boxes) {
          std::vector<axes> periodic{axes::all(dim)};
          if (reaches[0] < 4 && reaches[0] < reaches[1]) {
            if (dim > 1) periodic.insert(periodic.end(), {along_x, along_y});
            if (dim > 2) periodic.insert(periodic.end(), {along_xz, along_yz});
          }
          for (const axes& a : periodic) {
            const box_kind kind{dim, precision, H, reaches, a};
            if (precision == "mixed") continue;      // decides as double does
            if (H == 0.1 && kind.tight()) continue;  // 3 or 4 cells of 0.1 are not safe
            all.push_back(kind);
          }
        }
  return all;
}

template <class R>
std::vector<double> sharp_places(const setup& s, std::size_t d, bool few) {
  const box<1, R> axis = make_box_of_axis<R>(s, d);
  const R far = std::numeric_limits<R>::infinity(), H = static_cast<R>(s.constants.H);
  const R edge = axis.high[0] - axis.low[0];
  std::vector<R> faces{axis.low[0], axis.high[0], H};
  if (!few)
    for (const R width : {H, edge / 4, edge / std::floor(edge / H), edge / 8})
      for (R x = width; x < edge; x += width) faces.push_back(x);
  std::vector<double> places;
  for (const R face : faces)
    for (const R x : {std::nextafter(face, -far), face, std::nextafter(face, far)})
      if (x >= axis.low[0] && x <= axis.high[0] && std::ranges::find(places, x) == places.end()) places.push_back(x);
  return places;
}

class periodic_faces_test : public testing::TestWithParam<box_kind> {
 protected:
  /// A particle at every combination of sharp places.
  scene sharp() const {
    const box_kind& k = GetParam();
    std::vector<double> edges;
    for (const double a : k.reaches)
      edges.push_back(k.precision == "float" ? static_cast<double>(static_cast<float>(a * k.H)) : a * k.H);
    scene s = placed(k.dim, edges, k.H, 0, [](std::size_t) { return std::array<double, 3>{}; });
    std::vector<std::vector<double>> places;
    std::size_t n = 1;
    for (std::size_t d = 0; d < static_cast<std::size_t>(k.dim); ++d) {
      places.push_back(k.precision == "float" ? sharp_places<float>(s.world, d, k.dim == 3)
                                              : sharp_places<double>(s.world, d, k.dim == 3));
      n *= places.back().size();
    }
    s = placed(k.dim, edges, k.H, n, [&](std::size_t i) {
      std::array<double, 3> x{};
      for (std::size_t d = 0; d < places.size(); i /= places[d].size(), ++d) x[d] = places[d][i % places[d].size()];
      return x;
    });
    s.world.periodic = k.periodic;
    return s;
  }
};
INSTANTIATE_TEST_SUITE_P(box, periodic_faces_test, testing::ValuesIn(box_kinds()));

TEST_P(periodic_faces_test, no_pair_is_missed_or_summed_twice) {
  const scene s = sharp();
  const rate_table expected = count_by_hand(s, GetParam().precision);
  std::size_t summed = 0;
  for (const std::string& backend : backend_names())
    for (const grid_choice& grid : grids_round(counting(s, backend, 2, GetParam().precision))) {
      const auto sum = evaluated(counting(s, backend, grid, GetParam().precision), s.particles, 2);
      ASSERT_EQ(sum->rates().columns, expected.columns) << backend << " " << grid;
      ++summed;
    }
  // Cells that are wider by a skin may be too few to go round, as are 3 for the hashed grid.
  const auto without_skin = std::ranges::count_if(
      backend_names(), [](const auto& b) { return registry::instance().find_backend(b).traits.skin == 0; });
  EXPECT_GE(summed, 2 * static_cast<std::size_t>(without_skin));
}

/// In such boxes cells are H wide exactly, so that the hashed grid with 2^M H = the edge has the torus of the talk.
TEST(periodic_faces, cells_of_H_exactly_where_that_is_safe) {
  const auto cells = [](double low, double edge, double H, std::int64_t multiple) {
    box<1, double> omega{vec<1, double>(low), vec<1, double>(low + edge), axes::all(1)};
    return torus_cells(omega, H, multiple)[0];
  };
  EXPECT_EQ(cells(0, 1, 0.0625, 2), 16);
  EXPECT_EQ(cells(0, 1, 0.0625, 16), 16);
  EXPECT_EQ(cells(0, 1, 0.0625, 32), 0);
  EXPECT_EQ(cells(0.5, 1, 0.0625, 2), 14) << "x - A may round";
  EXPECT_EQ(cells(0, 5, 0.1, 2), 48) << "0.1 has no exact inverse";
  EXPECT_EQ(cells(0, 5, 1, 2), 4);
  EXPECT_EQ(cells(0, 4, 1, 2), 4);
  EXPECT_EQ(cells(0, 3.99, 1, 2), 3);
  EXPECT_EQ(cells(0, 3.99, 1, 4), 0) << "the hashed grid has 2^M";
  EXPECT_EQ(cells(0, 3, 1, 2), 3);
  EXPECT_EQ(cells(0.5, 3, 1, 2), 0) << "x - A may round";
  EXPECT_EQ(cells(0, 2.99, 1, 2), 0);
  EXPECT_EQ(cells(0, 48, 1, 32), 32);
}

}  // namespace
}  // namespace pairsum
