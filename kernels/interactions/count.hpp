#pragma once
#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// Counts neighbours and sums their ids, in 64-bit integers whatever the precision: exact, so it shows that each pair
/// was summed exactly once.
template <int D, class R>
class count {
 public:
  static constexpr std::string_view name = "count";
  static constexpr int dim = D;
  using real = R;
  static constexpr double boundary_reach = 1;
  static constexpr pair_flops flops{};  // integers

  template <class T>
  struct particle {
    std::uint64_t id;
    static constexpr auto fields() { return std::make_tuple(&particle::id); }
  };
  template <class T>
  using boundary_particle = particle<T>;
  template <class T>
  struct rates {
    std::uint64_t neighbours, ids;
    static constexpr auto fields() { return std::make_tuple(&rates::neighbours, &rates::ids); }
    static constexpr std::array<std::string_view, 2> names{"neighbours", "ids"};
  };

  explicit count(const physics&) {}

  template <class T>
  particle<T> derive(const particle_state<D, T>& s) const {
    return {s.id};
  }
  template <class T>
  particle<T> derive_boundary(const particle_state<D, T>& s) const {
    return {s.id};
  }
  template <class T>
  contributions<rates<T>> pair(const vec<D, T>&, const T&, const particle<T>& i, const particle<T>& j) const {
    return {{1, j.id}, {1, i.id}};
  }
  template <class T>
  rates<T> boundary(const vec<D, T>&, const T&, const particle<T>&, const particle<T>& b) const {
    return {1, b.id};
  }
};

}  // namespace pairsum
