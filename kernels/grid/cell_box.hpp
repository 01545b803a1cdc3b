#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cell_scale.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// A box of cells: coordinates low..high, both included; empty if high is -1.
template <int D>
struct cell_box {
  ivec<D> low{}, high = [] {
    ivec<D> none;
    none.fill(-1);
    return none;
  }();

  bool operator==(const cell_box&) const = default;
  bool empty() const { return high[0] < 0; }
  /// The smallest box around both.
  cell_box with(const cell_box& o) const;
  std::int64_t edge(int d) const { return high[d] - low[d] + 1; }
  /// Number of cells; 0 if it is empty. Exact up to 2^53.
  double cells() const;
  /// "3 x 4 x 5"
  std::string text() const;
};

/// The smallest box around the cells of particles begin..end that are summed: inside Omega and not lost. Without any it
/// is cell_box{}.
template <int D, class R>
cell_box<D> occupied_box(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const box<D, R>& omega,
                         const cell_scale<D, R>& scale, const team& t);

/// The box around all of them from step to step, which has all cells of a periodic axis; tests again only those that
/// may have moved.
template <int D, class R>
class box_follower {
 public:
  /// The first `moved` particles, or all, may be others than in the last call.
  cell_box<D> fit(const particle_set<D, R>& p, std::size_t moved, const box<D, R>& omega, const cell_scale<D, R>& scale,
                  const team& t);

 private:
  std::size_t rest_begin_ = ~std::size_t{0};
  cell_box<D> rest_;  ///< of the particles from rest_begin_ on
};

/// Numbers the cells of a box, x fastest, with an empty cell around: so the 3^D cells around any cell of the box have
/// numbers of their own, and no number wraps around an edge. There are no empty ones along an axis that closes on
/// itself.
template <int D>
class linear_cells {
 public:
  static constexpr std::size_t most = std::size_t{1} << 30;  ///< numbers, so that they leave 2 bits for the kind

  linear_cells() = default;
  /// `period`: see cell_scale; at most 2^30 numbers.
  linear_cells(const cell_box<D>& b, const ivec<D>& period);

  /// How many numbers a box takes, those around it included.
  static double numbers(const cell_box<D>& b, const ivec<D>& period);

  std::size_t size() const { return size_; }
  int bits() const;  ///< numbers are below 2^bits
  std::uint32_t stride(int d) const { return stride_[d]; }

  /// Writes the numbers of particles begin..end, which lie in the box (else the number does not matter), to out[0..].
  template <class R>
  void numbers_of(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const cell_scale<D, R>& scale,
                  std::span<std::uint32_t> out) const;
  /// Coordinates of a cell of the box, and back.
  ivec<D> place(std::uint32_t number) const;
  std::uint32_t number(const ivec<D>& at) const {
    std::uint32_t n = 0;
    for (int d = 0; d < D; ++d) n += part(d, at[d]);
    return n;
  }
  /// What coordinate a along axis d adds to a cell's number.
  std::uint32_t part(int d, std::int64_t a) const { return static_cast<std::uint32_t>(a - origin_[d]) * stride_[d]; }

 private:
  std::array<std::uint32_t, D> stride_{};
  ivec<D> origin_{};  ///< coordinates of cell number 0
  std::size_t size_ = 1;
};

}  // namespace pairsum
