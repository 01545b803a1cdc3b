#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "sum/registry.hpp"

namespace pairsum::harness {

/// What `pairsum verify` checks.
struct verify_plan {
  setup base;  ///< smoothing, precision, grid, dim; Omega and constants come from the case
  std::vector<std::string> interactions, backends;
  std::vector<int> M, threads;
};

/// One check: a backend with an interaction, M and threads.
struct verify_line {
  std::string interaction, backend;
  int M, threads;
  bool ok;
  double share;       ///< largest |rate - reference| over its bound; 0 for an exact match
  std::string error;  ///< empty if ok
};

/// Sums the case with every backend x M x threads (serial backends once) for every interaction, compares with the
/// reference, compares the counted pairs with the reference's, and demands equal bits over thread counts where the
/// backend claims them. Reports each line as it is made; returns whether all are fine.
bool verify_all(const registry& r, const initial_condition& c, const verify_plan& plan,
                const std::function<void(const verify_line&)>& report);

}  // namespace pairsum::harness
