#pragma once
#include <string>

#include "harness/rows/row.hpp"

/// A point in words, for lines and tables that people read.
namespace pairsum::harness {

/// What tells the cells of a point: "M=6", or "compact_grid" where the grid takes no M.
std::string cells_word(const point& p);

/// "symmetric_omp M=6 threads=2", "tiles_omp compact_grid threads=2"; with its block unless that is auto or none, and
/// its ranks where there are several: "naive_omp M=6 threads=1 ranks=2 twice".
std::string place_words(const point& p);

}  // namespace pairsum::harness
