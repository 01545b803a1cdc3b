#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include <pairsum/core/axes.hpp>
#include <pairsum/core/value.hpp>

namespace pairsum {

/// A vector of D components, unpadded.
template <int D, class T>
using vec = Eigen::Matrix<T, D, 1, Eigen::DontAlign>;

/// A cell's integer coordinates.
template <int D>
using ivec = std::array<std::int64_t, D>;

/// r.r in one fixed order of roundings. Every distance test of the library and of its references is this expression, in
/// the working precision, so that a pair near r = H is in or out for everybody alike; it is symmetric to the last bit
/// in r -> -r.
template <int D, class T>
inline T norm2(const vec<D, T>& r) {
  T sum = r[D - 1] * r[D - 1];
  for (int d = D - 2; d >= 0; --d) sum = fused(r[d], r[d], sum);
  return sum;
}

/// Flops of a distance test in D dimensions: x_i - x_j, norm2, the comparison. A fused multiply-add counts 2.
constexpr int distance_test_flops(int D) { return D + (2 * D - 1) + 1; }

/// A closed axis-parallel cuboid [low, high]; the Omega of the talk. Units: m. Along a periodic axis, what leaves
/// through a face comes back through the opposite one, and a point of the high face is one of the low face.
template <int D, class R>
struct box {
  vec<D, R> low, high;
  axes periodic = {};

  R edge(int d) const { return high[d] - low[d]; }
  /// Along a periodic axis: component d of a point, moved by whole edges into [low, high). A NaN for what is not
  /// finite.
  R wrapped(int d, R x) const {
    if (x >= low[d] && x < high[d]) return x;
    R from_low = std::fmod(x - low[d], edge(d));
    if (from_low < 0) from_low += edge(d);
    x = low[d] + from_low;
    return x >= high[d] ? low[d] : x;
  }
  bool contains(const vec<D, R>& x) const {
    bool inside = true;
    for (int d = 0; d < D; ++d) inside = inside && x[d] >= low[d] && x[d] <= high[d];
    return inside;  // a NaN is outside
  }
};

}  // namespace pairsum
