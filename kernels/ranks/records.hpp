#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <pairsum/particles/particle_set.hpp>

namespace pairsum::ranks {

/// A column of particles or of their rates, `width` bytes each.
struct byte_column {
  std::byte* begin;
  std::size_t width;
};

/// All columns of a set, those that an integrator carries among them. Valid until it is resized.
template <int D, class R>
std::vector<byte_column> columns_of(particle_set<D, R>& p) {
  std::vector<byte_column> all;
  p.each_column([&](auto& c) { all.push_back({reinterpret_cast<std::byte*>(c.data()), sizeof c[0]}); });
  return all;
}

/// Bytes of a record: an element of each column.
inline std::size_t record_bytes(std::span<const byte_column> columns) {
  std::size_t n = 0;
  for (const byte_column& c : columns) n += c.width;
  return n;
}

/// Calls f(width) with a width that is known when this is compiled, for those that occur.
template <class F>
void with_width(std::size_t width, F&& f) {
  if (width == 8)
    f(std::integral_constant<std::size_t, 8>{});
  else if (width == 4)
    f(std::integral_constant<std::size_t, 4>{});
  else
    f(width);
}

/// Elements `list` of the columns, one record after the other.
inline std::vector<std::byte> packed(std::span<const byte_column> columns, std::span<const std::uint32_t> list) {
  const std::size_t bytes = record_bytes(columns);
  std::vector<std::byte> records(list.size() * bytes);
  if (list.empty()) return records;
  std::byte* begin = records.data();
  for (const byte_column& c : columns) {
    with_width(c.width, [&](auto width) {
      std::byte* to = begin;
      for (const std::uint32_t i : list) {
        std::memcpy(to, c.begin + i * width, width);
        to += bytes;
      }
    });
    begin += c.width;
  }
  return records;
}

/// Writes records to elements at(0), at(1), ... of the columns.
template <class At>
void unpack(std::span<const byte_column> columns, const std::vector<std::byte>& records, At&& at) {
  const std::size_t bytes = record_bytes(columns), n = records.size() / bytes;
  if (n == 0) return;
  const std::byte* begin = records.data();
  for (const byte_column& c : columns) {
    with_width(c.width, [&](auto width) {
      const std::byte* from = begin;
      for (std::size_t k = 0; k < n; ++k) {
        std::memcpy(c.begin + at(k) * width, from, width);
        from += bytes;
      }
    });
    begin += c.width;
  }
}

}  // namespace pairsum::ranks
