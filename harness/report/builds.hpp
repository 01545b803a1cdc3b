#pragma once
#include <set>
#include <string>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// The machines and builds that environment rows name: what may not be mixed in one comparison.
class builds {
 public:
  /// The index of the environment's machine and build (host, cpu, compiler, flags, git, uncommitted changes, binding).
  std::size_t add(const environment_row& e);

  const environment_row& first(std::size_t build) const { return known_[build]; }
  std::size_t size() const { return known_.size(); }

  /// Notes the builds that were measured in the same round: they are what the study compares.
  void measured_together(const std::set<std::size_t>& in_one_round);
  /// Are there several, and was every one measured together with the first?
  bool are_a_factor() const { return known_.size() > 1 && together_.size() == known_.size(); }

  /// What differs between them, like `host (a, b), git (x, y)`; empty if nothing does.
  std::string differences() const;

 private:
  std::vector<environment_row> known_;
  std::set<std::size_t> together_;
};

/// Which build an environment is, in as few words as tell it: "GNU 12.2.0, git 0123abc".
std::string build_name(const environment_row& e);

}  // namespace pairsum::harness
