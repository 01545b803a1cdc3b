#pragma once
#include <functional>
#include <string>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/sum/registry.hpp>

namespace pairsum::harness {

/// A sum to be checked: its words; dimension, Omega and constants come from the case.
struct verify_sum {
  setup words;
  int threads = 1;
  std::string cut = "none";  ///< of pairs across ranks
};

/// What `pairsum verify` checks: per formula (precision, interaction, smoothing kernel) at least one sum.
using verify_plan = std::vector<std::vector<verify_sum>>;

/// One check of a sum.
struct verify_line {
  setup sum;  ///< smoothing is "none" where the interaction takes none
  int threads;
  std::string cut;  ///< "none" on one rank
  bool ok;
  double share;       ///< largest |rate - reference| over its bound; 0 for an exact match
  std::string error;  ///< empty if ok
};

/// Makes every sum, with the ranks of the job that this process is of, compares with the reference of its formula,
/// compares the counted pairs with the reference's, and demands equal bits over thread counts where the backend claims
/// them. Reports each line as it is made; returns whether all are fine.
bool verify_all(const registry& r, const initial_condition& c, const verify_plan& plan,
                const std::function<void(const verify_line&)>& report);

}  // namespace pairsum::harness
