#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/sum/problem.hpp>

namespace pairsum {

/// How far particles have moved.
template <int D, class R>
class displacement {
 public:
  /// From now on, for the first n particles.
  void since(const positions<D, R>& x, std::size_t n, const team& t) {
    for (auto& column : start_) column.resize(n);
    t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (int d = 0; d < D; ++d) std::copy(x.column[d] + begin, x.column[d] + end, start_[d].data() + begin);
    });
  }

  /// Have they stayed the same number, and has none moved by more than `limit` (m)? No if a position is NaN.
  bool at_most(R limit, const positions<D, R>& x, std::size_t n, const team& t) const {
    if (n != start_[0].size()) return false;
    std::vector<std::uint8_t> fine(static_cast<std::size_t>(t.threads()), 1);
    t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t piece) {
      unsigned within = 1;
      for (std::size_t i = begin; i < end; ++i) {
        R square = 0;
        for (int d = 0; d < D; ++d) {
          const R step = x.column[d][i] - start_[d][i];
          square += step * step;
        }
        within &= static_cast<unsigned>(square <= limit * limit);
      }
      fine[piece] = static_cast<std::uint8_t>(within);
    });
    return std::ranges::count(fine, 0) == 0;
  }

 private:
  std::array<column<R>, D> start_;
};

}  // namespace pairsum
