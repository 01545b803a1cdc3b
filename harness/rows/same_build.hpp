#pragma once
#include <map>
#include <tuple>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

inline bool same_machine(const environment_row& a, const environment_row& b) {
  return a.host == b.host && a.cpu == b.cpu;
}

/// The plug-ins among an environment's libraries, by key.
inline std::map<std::string, std::string> plugins_of(const environment_row& e) {
  std::map<std::string, std::string> found = e.libraries;
  std::erase_if(found, [](const auto& library) { return !library.first.starts_with("plugin "); });
  return found;
}

/// Do both name the same machine, build and plug-ins? Rows of two that do not are never mixed.
inline bool same_build(const environment_row& a, const environment_row& b) {
  const auto build = [](const environment_row& e) { return std::tie(e.compiler, e.flags, e.git, e.dirty, e.binding); };
  return same_machine(a, b) && build(a) == build(b) && plugins_of(a) == plugins_of(b);
}

}  // namespace pairsum::harness
