#pragma once
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include <pairsum/particles/particle_set.hpp>

namespace pairsum::ranks {

/// Bytes of a particle with all its columns, those that an integrator carries among them.
template <int D, class R>
std::size_t record_bytes(particle_set<D, R>& p) {
  std::size_t n = 0;
  p.each_column([&](auto& c) { n += sizeof c[0]; });
  return n;
}

/// Particles `list` of the set, one record after the other.
template <int D, class R>
std::vector<std::byte> packed(particle_set<D, R>& p, std::span<const std::uint32_t> list) {
  const std::size_t bytes = record_bytes(p);
  std::vector<std::byte> records(list.size() * bytes);
  if (list.empty()) return records;
  std::size_t offset = 0;
  p.each_column([&](auto& c) {
    std::byte* to = records.data() + offset;
    for (const std::uint32_t i : list) {
      std::memcpy(to, &c[i], sizeof c[0]);
      to += bytes;
    }
    offset += sizeof c[0];
  });
  return records;
}

/// Writes records to particles at(0), at(1), ... of the set.
template <int D, class R, class At>
void unpack(particle_set<D, R>& p, const std::vector<std::byte>& records, At&& at) {
  const std::size_t bytes = record_bytes(p), n = records.size() / bytes;
  if (n == 0) return;
  std::size_t offset = 0;
  p.each_column([&](auto& c) {
    const std::byte* from = records.data() + offset;
    for (std::size_t k = 0; k < n; ++k) {
      std::memcpy(&c[at(k)], from, sizeof c[0]);
      from += bytes;
    }
    offset += sizeof c[0];
  });
}

}  // namespace pairsum::ranks
