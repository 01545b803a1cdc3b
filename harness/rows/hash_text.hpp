#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace pairsum::harness {

/// 16 hexadecimal digits that tell texts apart (FNV-1a, 64 bits: Fowler, Noll, Vo).
inline std::string hash_text(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

}  // namespace pairsum::harness
