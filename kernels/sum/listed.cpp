// Sums of pairs that were listed before.
#include <algorithm>
#include <vector>

#include <pairsum/core/same_code.hpp>
#include <pairsum/sum/cut_meetings.hpp>
#include <pairsum/sum/pack.hpp>

namespace pairsum {
namespace {

/// Hands rows made from listed ones on, a few at a time. make(row, at) writes up to room_of(row) partners to `at`,
/// which it moves behind them.
template <std::size_t capacity, class RoomOf, class Make>
[[gnu::always_inline]] inline void hand_on(const row_sink& sink, const row* listed, std::size_t n, RoomOf&& room_of,
                                           Make&& make) {
  std::uint32_t hits[capacity];
  row rows[most_rows];
  std::uint32_t* to = hits;
  std::size_t filled = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t room = room_of(listed[k]);
    if (filled == most_rows || room > static_cast<std::size_t>(hits + capacity - to)) {
      sink.take(sink.call, rows, filled);
      to = hits;
      filled = 0;
      if (room > capacity) [[unlikely]] {
        std::vector<std::uint32_t> own(room);
        std::uint32_t* at = own.data();
        const row r = make(listed[k], at);
        sink.take(sink.call, &r, 1);
        continue;
      }
    }
    rows[filled] = make(listed[k], to);
    filled += rows[filled].fluid_count + rows[filled].boundary_count > 0;
  }
  if (filled > 0) sink.take(sink.call, rows, filled);
}

/// The partners of listed rows that are within the cutoff.
template <int D, class R>
PAIRSUM_SAME_CODE void filter_rows(const problem<D, R>& p, const row_sink& sink, const row* listed, std::size_t n) {
  const auto room_of = [](const row& from) { return from.fluid_count + from.boundary_count + std::size_t(1); };
  const auto make = [&](const row& from, std::uint32_t*& at) __attribute__((always_inline)) {
    const auto x_i = p.x.point_of(from.i);
    const auto some = [&](const std::uint32_t* list, std::uint32_t size, R reach2) __attribute__((always_inline)) {
      at = pack_of(
          p.x, x_i, reach2, 0, size, at, [&](std::uint32_t k) __attribute__((always_inline)) { return list[k]; });
    };
    row r{at, nullptr, 0, 0, from.i};
    some(from.fluid, from.fluid_count, p.reach2);
    r.boundary = at;
    some(from.boundary, from.boundary_count, p.boundary_reach2);
    r.fluid_count = static_cast<std::uint32_t>(r.boundary - r.fluid);
    r.boundary_count = static_cast<std::uint32_t>(at - r.boundary);
    if (p.counts != nullptr) [[unlikely]] {
      p.counts->pairs_tested += from.fluid_count + from.boundary_count;
      p.counts->pairs_fluid_fluid += r.fluid_count;
      p.counts->pairs_fluid_boundary += r.boundary_count;
      for (std::uint32_t k = 0; k < r.fluid_count; ++k)
        p.counts->pairs_cut += state_of_pair<D, R>(p, r.i, r.fluid[k]) == cut_state::ours;
    }
    return r;
  };
  hand_on<most_hits + 1>(sink, listed, n, room_of, make);
}

/// Rows as vector units want them: fluid partners with padding behind. They test distances themselves.
PAIRSUM_SAME_CODE void padded_rows(const row_sink& sink, const row* listed, std::size_t n) {
  const auto room_of = [](const row& from) { return std::size_t(from.fluid_count) + 2 * row_padding; };
  const auto make = [&](const row& from, std::uint32_t*& at) {
    std::copy_n(from.fluid, from.fluid_count, at);
    for (std::uint32_t k = 0; k < row_padding; ++k) at[from.fluid_count + k] = sink.spare + k;
    row r = from;
    r.fluid = at;
    at += (from.fluid_count + row_padding - 1) / row_padding * row_padding;  // whole vectors
    return r;
  };
  hand_on<2048>(sink, listed, n, room_of, make);
}

}  // namespace

template <int D, class R>
void sum_listed(const problem<D, R>& p, const target& to, const row* rows, std::size_t n, bool tested) {
  const sum_call<D, R> call{p, to};
  const row_sink sink{both_sides(p, to.how), &call, p.spare_of(to.thread)};
  if (p.lanes != nullptr) return padded_rows(sink, rows, n);
  const auto hand_to = [&](const row_sink& taker) {
    if (tested)
      filter_rows(p, taker, rows, n);
    else
      taker.take(taker.call, rows, n);
  };
  if (p.counts == nullptr) return hand_to(sink);
  const counted_rows counted{sink, *p.counts};
  hand_to({&counted_rows::take, &counted});
}

#define PAIRSUM_LISTED(D, R) \
  template void sum_listed(const problem<D, R>&, const target&, const row*, std::size_t, bool);
PAIRSUM_EACH_D_R(PAIRSUM_LISTED)

}  // namespace pairsum
