#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// What is compared with what.
struct compare_request {
  std::string a, b;  ///< two backends (see compared_side), two rows files (or folders), or two git revisions
  std::vector<std::filesystem::path> inputs;  ///< rows files or folders that hold the backends or revisions
  std::optional<double> phases::*phase = &phases::sum_s;
  bool allow_mixed = false;  ///< different machines, or builds with uncommitted changes
};

/// Says in a table and a sentence whether b is faster than a, by how much and with what confidence, at every point that
/// both have. Two backends, and two revisions that were measured in the same rounds, are paired by round; what was
/// measured apart is compared unpaired (Welch). The comparisons are judged together (Holm, 95 %). What else differs
/// between the two is said, and refused if it is the machine or uncommitted changes. Throws pairsum::error with one
/// line for names that are neither, for rows without the points, and for what read_rows refuses.
std::string compare_sides(const compare_request& r);

}  // namespace pairsum::harness
