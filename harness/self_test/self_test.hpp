#pragma once
#include <pairsum/sum/registry.hpp>
#include "harness/self_test/entries.hpp"

namespace pairsum::harness {

/// `base` with the backends of self_test_entries() besides, those whose own base it has. A study of them shows whether
/// the program tells what is the same, what is slower by a known share, and what is wrong. Throws pairsum::error if
/// `base` has one of their names already.
registry with_self_test(const registry& base);

}  // namespace pairsum::harness
