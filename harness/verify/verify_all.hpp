#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "sum/registry.hpp"

namespace pairsum::harness {

/// What `pairsum verify` checks.
struct verify_plan {
  setup base;  ///< the grid; the dimension, Omega and constants come from the case
  std::vector<std::string> precisions{"double"}, interactions, smoothings{"wendland_c2"}, backends;
  std::vector<int> M, threads;
};

/// One check: a backend with a formula, M and threads.
struct verify_line {
  std::string precision, interaction, smoothing, backend;  ///< smoothing is "none" where the interaction takes none
  int M, threads;
  bool ok;
  double share;       ///< largest |rate - reference| over its bound; 0 for an exact match
  std::string error;  ///< empty if ok
};

/// Sums the case with every backend x M x threads (serial backends once) for every precision x interaction x smoothing
/// kernel (interactions that take none: once), compares with the reference, compares the counted pairs with the
/// reference's, and demands equal bits over thread counts where the backend claims them. Reports each line as it is
/// made; returns whether all are fine.
bool verify_all(const registry& r, const initial_condition& c, const verify_plan& plan,
                const std::function<void(const verify_line&)>& report);

}  // namespace pairsum::harness
