#pragma once
#include <tuple>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

inline bool same_machine(const environment_row& a, const environment_row& b) {
  return a.host == b.host && a.cpu == b.cpu;
}

/// Do both name the same machine and build? Rows of two that do not are never mixed.
inline bool same_build(const environment_row& a, const environment_row& b) {
  const auto build = [](const environment_row& e) { return std::tie(e.compiler, e.flags, e.git, e.dirty, e.binding); };
  return same_machine(a, b) && build(a) == build(b);
}

}  // namespace pairsum::harness
