#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <pairsum/core/axes.hpp>
#include <pairsum/ranks/partition.hpp>

namespace pairsum::ranks {

/// The ranks whose box is within reach of a point, also through periodic faces.
class near_boxes {
 public:
  using place = std::array<double, 3>;

  /// Of a domain [low, high] of `dim` dimensions; m.
  near_boxes(int dim, const place& low, const place& high, const axes& periodic, double reach)
      : dim_(dim), low_(low), high_(high), periodic_(periodic), reach_(reach) {}

  /// Takes the boxes of all ranks, as seen by one of them.
  void find(const std::vector<rank_box>& boxes, int here);

  /// Calls f(rank), once each, for the ranks within reach of x, wherever that is.
  template <class F>
  void each(const place& x, F&& f) {
    each_of(everywhere_, x, f);
  }
  /// The same for an x in the box of this rank; fewer boxes are looked at. This rank is among them only if its own box
  /// is within reach through a face.
  template <class F>
  void each_near(const place& x, F&& f) {
    each_of(near_, x, f);
  }

 private:
  /// A box moved by whole edges of a periodic domain, and farther out by the reach.
  struct image {
    int rank;
    place low, high;
  };

  template <class F>
  void each_of(std::span<const image> boxes, const place& x, F& f) {
    found_.clear();
    for (const image& b : boxes) {
      bool inside = true;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d)
        inside = inside && x[d] >= b.low[d] && x[d] <= b.high[d];
      if (inside) found_.push_back(b.rank);
    }
    if (found_.size() > 1) {  // through several faces
      std::ranges::sort(found_);
      found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    }
    for (const int rank : found_) f(rank);
  }

  int dim_;
  place low_, high_;
  axes periodic_;
  double reach_;
  std::vector<image> near_, everywhere_;
  std::vector<int> found_;
};

}  // namespace pairsum::ranks
