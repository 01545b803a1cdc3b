#pragma once
#include <algorithm>
#include <vector>

#include "core/team.hpp"
#include "sum/problem.hpp"

namespace pairsum {

/// Copies of the rates' columns, in which threads or passes add on their own; joined in a fixed order. Copy 0 is the
/// rates themselves.
template <class I>
class private_columns {
  using rates = rates_of<I>;

 public:
  void resize(std::size_t copies, std::size_t particles) {
    rest_.resize(copies > 0 ? copies - 1 : 0);
    for (auto& columns : rest_) columns.resize(particles);
  }
  std::size_t copies() const { return rest_.size() + 1; }
  /// The problem, but for a sum that adds to copy k.
  problem<I> with_copy(const problem<I>& p, std::size_t k) {
    problem<I> own = p;
    if (k > 0) own.u = rest_[k - 1].pointers();
    return own;
  }

  /// Adds all copies to the rates, each particle's in the order of the copies.
  void join(const problem<I>& p, const team& t) {
    std::vector<field_pointers<rates>> from;
    for (auto& columns : rest_) from.push_back(columns.pointers());
    constexpr std::size_t piece = 1024;  // of a column, which stays in the first cache meanwhile
    t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (; begin < end; begin += piece) {
        const std::size_t stop = std::min(begin + piece, end);
        each_scalar(zero<rates>(), [&](const auto& a, int slot) {
          using scalar = std::remove_cvref_t<decltype(a)>;
          scalar* const u = p.u.template column_as<scalar>(slot);
          for (const auto& f : from) {
            const scalar* const add = f.template column_as<scalar>(slot);
            for (std::size_t i = begin; i < stop; ++i) u[i] += add[i];
          }
        });
      }
    });
  }

 private:
  std::vector<field_columns<rates>> rest_;
};

/// Sets the rates of particles begin..end to 0.
template <class S>
void zero_range(const field_pointers<S>& u, std::size_t begin, std::size_t end) {
  each_scalar(zero<S>(), [&](const auto& a, int slot) {
    using scalar = std::remove_cvref_t<decltype(a)>;
    std::fill(u.template column_as<scalar>(slot) + begin, u.template column_as<scalar>(slot) + end, scalar(0));
  });
}

}  // namespace pairsum
