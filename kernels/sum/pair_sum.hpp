#pragma once
#include <span>

#include <pairsum/sum/rate_view.hpp>

namespace pairsum {

template <int D, class R>
struct problem;

/// Listed partners of fluid particle i.
struct row {
  const std::uint32_t *fluid, *boundary;  ///< where they are listed
  std::uint32_t fluid_count, boundary_count;
  std::uint32_t i;
};

/// Vector units read so many partners behind a row's last: as many as the widest vector has lanes.
inline constexpr std::size_t row_padding = 16;

/// What a call of a rows_function belongs to.
template <int D, class R>
struct sum_call {
  const problem<D, R>& p;
  const target& to;
};

/// Takes rows; `call` is a sum_call<D, R>, or whatever the function expects.
using rows_function = void (*)(const void* call, const row* rows, std::size_t n);

/// The function that takes listed rows.
struct row_sink {
  rows_function take;
  const void* call;
  std::uint32_t spare = 0;  ///< for vector units: the first of the rows behind the fluid that this thread may name
};

/// A formula as schedules see it: functions on listed rows and on rates. This is all there is of it.
template <int D, class R>
struct pair_sum {
  rows_function both[updates];  ///< both sides of each pair; nullptr where an update is unavailable
  rows_function own;            ///< the particle's own side; without vector units the rates are written, not added to
  /// On vector units: finds and sums the pairs of cell[0..n) in one function, of half stencils both sides, of full ones
  /// the own side.
  using of_cells = void (*)(const sum_call<D, R>&, const std::uint32_t* cell, std::size_t n);
  of_cells half_stencils, full_stencils;
  /// Software prefetch of the fluid of cells, with its rates in `rates` (nullptr: without). Prefetching rates that
  /// another thread adds to would take their cache lines from it.
  void (*fetch)(const problem<D, R>&, const std::uint32_t* cells, unsigned n, const rate_view* rates);
  void (*zero)(const rate_view& u, std::size_t begin, std::size_t end);
  /// to[to_at + k] += from[from_at + k] for k < n
  void (*add)(const rate_view& to, std::size_t to_at, const rate_view& from, std::size_t from_at, std::size_t n);
  std::span<const std::uint16_t> rate_bytes;  ///< of a particle, by column
};

}  // namespace pairsum
