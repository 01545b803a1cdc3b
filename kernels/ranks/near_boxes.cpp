#include <pairsum/ranks/near_boxes.hpp>

namespace pairsum::ranks {

void near_boxes::find(const std::vector<rank_box>& boxes, int here) {
  near_.clear();
  everywhere_.clear();
  const rank_box& own = boxes[static_cast<std::size_t>(here)];
  unsigned images = 1;
  for (int d = 0; d < dim_; ++d) images *= 3;
  for (std::size_t rank = 0; rank < boxes.size(); ++rank)
    for (unsigned number = 0; number < images; ++number) {
      image b{static_cast<int>(rank), boxes[rank].low, boxes[rank].high};
      bool exists = true, meets_own = true;
      unsigned code = number;
      for (int d = 0; d < dim_; ++d, code /= 3) {
        const auto a = static_cast<std::size_t>(d);
        const int turns = static_cast<int>(code % 3) - 1;
        exists = exists && (turns == 0 || periodic_[d]);
        if (periodic_[d]) {  // a box without an end ends at the faces
          b.low[a] = std::max(b.low[a], low_[a]);
          b.high[a] = std::min(b.high[a], high_[a]);
        }
        const double by = turns * (high_[a] - low_[a]);
        b.low[a] += by - reach_;
        b.high[a] += by + reach_;
        meets_own = meets_own && b.low[a] <= own.high[a] && b.high[a] >= own.low[a];
      }
      if (!exists) continue;
      everywhere_.push_back(b);
      if (meets_own && (b.rank != here || number != images / 2)) near_.push_back(b);
    }
}

}  // namespace pairsum::ranks
