#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include <pairsum/core/vec.hpp>

namespace pairsum {

/// The displacement between two points of Omega. Along periodic axes it is the minimum image: the shortest of the
/// displacements through and not through the faces. All code uses this one expression. x_i - x_j and x_j - x_i are
/// equal to the last bit but for the sign, so i and j agree on whether they interact.
template <int D, class R>
struct torus {
  bool periodic = false;                            ///< along any axis
  vec<D, R> edge = vec<D, R>::Zero(), half = edge;  ///< m; 0 along open axes, whose displacements stay as they are
  vec<D, R> inner_low = edge, inner_high = edge;    ///< neighbours of points between these lie inside of the faces

  torus() = default;
  torus(const box<D, R>& omega, R H) : periodic(omega.periodic.any()) {
    constexpr R u = std::numeric_limits<R>::epsilon();
    for (int d = 0; d < D; ++d) {
      inner_high[d] = std::numeric_limits<R>::infinity();
      inner_low[d] = -inner_high[d];
      if (!omega.periodic[d]) continue;
      edge[d] = omega.edge(d);
      half[d] = edge[d] / 2;
      // Wider than H by what rounding can do to a difference.
      const R far = std::max(std::abs(omega.low[d]), std::abs(omega.high[d])) + edge[d];
      const R rim = R(1.01) * H + 8 * u * far;
      inner_low[d] = omega.low[d] + rim;
      inner_high[d] = omega.high[d] - rim;
    }
  }

  /// This, if a neighbour of x may lie beyond a face; else, and always without periodic faces, nullptr.
  [[gnu::always_inline]] const torus* seen_from(const vec<D, R>& x) const {
    return periodic && near_face(x) ? this : nullptr;
  }
  bool near_face(const vec<D, R>& x) const {
    bool near = false;
    for (int d = 0; d < D; ++d) near = near || !(x[d] >= inner_low[d] && x[d] <= inner_high[d]);
    return near;
  }
  /// How much rounding changes a displacement through the faces at most, m; 0 without periodic faces.
  R rounding() const { return periodic ? std::numeric_limits<R>::epsilon() * edge.maxCoeff() : R(0); }
  /// Makes r its minimum image; each component of r is at most an edge.
  [[gnu::always_inline]] void to_minimum_image(vec<D, R>& r) const {
    for (int d = 0; d < D; ++d) r[d] -= r[d] > half[d] ? edge[d] : r[d] < -half[d] ? -edge[d] : R(0);
  }
};

/// A point of Omega whose differences are minimum-image displacements: the difference of two points leads from the
/// second to the first. The first one decides whether faces are considered, so a loop over the second has no branch
/// that differs from point to point. Right for points less than H apart.
template <int D, class R>
struct point {
  vec<D, R> x;
  const torus<D, R>* across;  ///< nullptr: no neighbour lies beyond a face

  [[gnu::always_inline]] operator const vec<D, R>&() const { return x; }  // NOLINT: it is one
  [[gnu::always_inline]] R operator[](int d) const { return x[d]; }

  [[gnu::always_inline]] friend vec<D, R> operator-(const point& a, const point& b) { return a - b.x; }
  [[gnu::always_inline]] friend vec<D, R> operator-(const point& a, const vec<D, R>& b) {
    vec<D, R> r = a.x - b;
    if (a.across != nullptr) [[unlikely]]
      a.across->to_minimum_image(r);
    return r;
  }
  [[gnu::always_inline]] friend vec<D, R> operator-(const vec<D, R>& a, const point& b) { return -(b - a); }
};

/// f(x), compiled once for points deep inside and once for those near a face: a loop in f over x - x_j has no branch
/// for faces then, which compilers need to put it on vector units.
template <int D, class R, class F>
[[gnu::always_inline]] inline void either_side(const point<D, R>& x, F&& f) {
  if (x.across == nullptr) [[likely]]
    f(point<D, R>{x.x, nullptr});
  else
    f(x);
}

}  // namespace pairsum
