#pragma once
#include <array>
#include <cstddef>
#include <vector>

struct Zoltan_Struct;

namespace pairsum::ranks {

/// Points and weights that are to be shared out.
struct weighted_points {
  int dim = 3;
  std::vector<std::array<double, 3>> x;  ///< m
  std::vector<float> weight;
};

/// What a rank owns; infinite where it has no end, and along axes that the domain does not have.
struct rank_box {
  std::array<double, 3> low, high;  ///< m
};

/// The domain cut into boxes of equal weight, one for each rank: recursive coordinate bisection (Berger & Bokhari, IEEE
/// Trans. Comput. C-36 (1987) 570) of Zoltan, whose cuts are kept. The outermost boxes have no end.
class partition {
 public:
  partition();
  ~partition();
  partition(const partition&) = delete;
  partition& operator=(const partition&) = delete;

  /// Cuts anew; collective. Each rank passes the points that it has; the last cuts are where the search begins. Without
  /// any point they stay; before the first cut rank 0 has everything.
  void cut(const weighted_points& own);

  /// The box of each rank, by rank.
  const std::vector<rank_box>& boxes() const { return boxes_; }
  /// The rank whose box holds x.
  int rank_of(const std::array<double, 3>& x) const;

 private:
  Zoltan_Struct* zoltan_ = nullptr;
  bool has_cuts_ = false;
  std::vector<rank_box> boxes_;
};

}  // namespace pairsum::ranks
