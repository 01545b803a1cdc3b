#pragma once
#include <algorithm>
#include <span>
#include <tuple>

#include <pairsum/core/team.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// Applies a permutation to columns: element k becomes what was at `source[k]`, for the first source.size() elements.
/// Keeps its scratch memory from call to call.
class reorderer {
 public:
  template <class T>
  void apply(column<T>& c, std::span<const std::uint32_t> source, const team& t) {
    column<T>& scratch = std::get<column<T>>(scratch_);
    scratch.resize(source.size());
    T* const to = scratch.data();
    t.for_pieces(source.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; ++k) to[k] = c[source[k]];
    });
    if (source.size() == c.size()) return c.swap(scratch);
    t.for_pieces(source.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      std::copy(to + begin, to + end, c.begin() + static_cast<std::ptrdiff_t>(begin));
    });
  }

  template <int D, class R>
  void apply(particle_set<D, R>& p, std::span<const std::uint32_t> source, const team& t) {
    p.each_column([&](auto& c) { apply(c, source, t); });
  }

 private:
  std::tuple<column<double>, column<float>, column<std::uint32_t>, column<particle_kind>> scratch_;
};

}  // namespace pairsum
