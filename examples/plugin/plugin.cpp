// The plug-in "example": a backend and an interaction of one's own, for pairsum list, verify, run and tune, and for
// pairsum_bench, with --plugin example.so. It belongs to the build of pairsum that it was made with; others refuse it.
#include <pairsum/plugin.hpp>
#include <pairsum/sum/registry.hpp>

namespace pairsum::backends {
backend_entry reverse_passes();  // reverse_passes.cpp
}
pairsum::formula_entry density_entry();  // density.cpp

static void add_all(pairsum::registry& r) {
  r.add(pairsum::backends::reverse_passes());
  r.add(density_entry());
}

PAIRSUM_PLUGIN(example, add_all)
