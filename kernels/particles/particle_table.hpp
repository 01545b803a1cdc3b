#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// More cannot be numbered with 32 bits, some of which mean something else.
inline constexpr std::size_t most_particles = 0xffffffffu - 1024;

/// Particles of any dimension in double precision: what cases make, files hold and references read. Rows are in id
/// order: the particle with id k is row k, fluid first, then boundary. Units as in particle_set.
struct particle_table {
  int dim = 3;
  std::vector<std::vector<double>> x, v;  ///< dim columns each
  std::vector<double> rho, m;
  std::vector<particle_kind> kind;

  explicit particle_table(int dimensions = 3) : dim(dimensions), x(dim), v(dim) {}
  std::size_t size() const { return kind.size(); }
  std::size_t count(particle_kind k) const {
    std::size_t n = 0;
    for (const auto a : kind) n += a == k;
    return n;
  }
  void resize(std::size_t n) {
    for (auto& c : x) c.resize(n);
    for (auto& c : v) c.resize(n);
    rho.resize(n);
    m.resize(n);
    kind.resize(n);
  }
};

/// Element k of the set becomes the particle with this id.
template <int D, class R>
void copy_row(particle_set<D, R>& p, std::size_t k, const particle_table& table, std::uint32_t id) {
  for (int d = 0; d < D; ++d) {
    p.x[d][k] = static_cast<R>(table.x[d][id]);
    p.v[d][k] = static_cast<R>(table.v[d][id]);
  }
  p.rho[k] = static_cast<R>(table.rho[id]);
  p.m[k] = static_cast<R>(table.m[id]);
  p.kind[k] = table.kind[id];
  p.id[k] = id;
}

/// Copies a table into a set of the working precision, in the given order of memory: element k of the set is the
/// particle with id `order[k]`; an empty order means id order. The team's threads write what will be theirs once the
/// fluid lies before the rest, so that on a machine with several NUMA nodes new memory lies with who uses it.
template <int D, class R>
void fill(particle_set<D, R>& p, const particle_table& table, const std::vector<std::uint32_t>& order = {},
          const team& t = {}) {
  const std::size_t n = order.empty() ? table.size() : order.size(), fluid = table.count(particle_kind::fluid);
  p.resize(n);
  const auto copy = [&](std::size_t k) {
    copy_row(p, k, table, order.empty() ? static_cast<std::uint32_t>(k) : order[k]);
  };
  t.for_pieces(fluid, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) copy(k);
  });
  t.for_pieces(n - fluid, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) copy(fluid + k);
  });
}

/// The set's particles as a table of `rows` rows in id order; a float becomes the double of the same value. Ids the set
/// does not hold are `lost`.
template <int D, class R>
particle_table to_table(const particle_set<D, R>& p, std::size_t rows) {
  particle_table table(D);
  table.resize(rows);
  table.kind.assign(rows, particle_kind::lost);
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::uint32_t id = p.id[k];
    for (int d = 0; d < D; ++d) {
      table.x[d][id] = static_cast<double>(p.x[d][k]);
      table.v[d][id] = static_cast<double>(p.v[d][k]);
    }
    table.rho[id] = static_cast<double>(p.rho[k]);
    table.m[id] = static_cast<double>(p.m[k]);
    table.kind[id] = p.kind[k];
  }
  return table;
}

}  // namespace pairsum
