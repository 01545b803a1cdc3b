#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <pairsum/core/column.hpp>
#include <pairsum/core/vec.hpp>

namespace pairsum {

/// What a particle is; place_of() says where kinds lie in memory after indexing.
enum class particle_kind : std::uint8_t {
  fluid = 0,     ///< contributes and is updated
  boundary = 1,  ///< contributes and is never updated
  lost = 2,      ///< left Omega during stepping: kept, no longer summed
  ghost = 4,     ///< copy of another rank's fluid, among the fluid: contributes; its owner updates it
};

/// Where a kind lies in memory: fluid with its ghosts, boundary, lost.
constexpr std::uint32_t place_of(particle_kind k) { return static_cast<std::uint32_t>(k) & 3; }

/// Particles as one column per quantity (SoA), in any order. SI units: x in m, v in m/s, rho in kg/m3, m in kg.
template <int D, class R>
struct particle_set {
  std::array<column<R>, D> x, v;
  column<R> rho, m;
  column<std::uint32_t> id;
  column<particle_kind> kind;
  std::vector<column<R>> carried;  ///< what an integrator keeps with the particles from stage to stage
  std::vector<column<R>> since;    ///< positions at an earlier time, or none

  std::size_t size() const { return id.size(); }

  void resize(std::size_t n) {
    for (auto& c : x) c.resize(n);
    for (auto& c : v) c.resize(n);
    rho.resize(n);
    m.resize(n);
    id.resize(n);
    kind.resize(n);
    for (auto& c : carried) c.resize(n);
    for (auto& c : since) c.resize(n);
  }

  /// Makes room for `columns` carried columns; their values are undefined until written.
  void carry(std::size_t columns) {
    carried.resize(columns);
    for (auto& c : carried) c.resize(size());
  }

  vec<D, R> position(std::size_t i) const { return gather(x, i); }
  vec<D, R> velocity(std::size_t i) const { return gather(v, i); }

  /// Calls f on every column.
  template <class F>
  void each_column(F&& f) {
    for (auto& c : x) f(c);
    for (auto& c : v) f(c);
    f(rho);
    f(m);
    f(id);
    f(kind);
    for (auto& c : carried) f(c);
    for (auto& c : since) f(c);
  }

 private:
  static vec<D, R> gather(const std::array<column<R>, D>& c, std::size_t i) {
    vec<D, R> a;
    for (int d = 0; d < D; ++d) a[d] = c[d][i];
    return a;
  }
};

}  // namespace pairsum
