#pragma once
#include <pairsum/sum/registry.hpp>
#include "broken_backends.hpp"
#include "library_formulas.hpp"

namespace pairsum {

/// A registry that holds the talk's passes with planted faults, the sound one among them, and the true references.
inline registry broken_registry() {
  registry r;
  for (const backend_entry& b : broken_backends()) r.add(b);
  r.add(test_kit::ferrari09_3d());
  r.add(test_kit::counting_formula<3>());
  return r;
}

}  // namespace pairsum
