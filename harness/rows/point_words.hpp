#pragma once
#include <string>

#include "harness/rows/row.hpp"

/// A point in words, for lines and tables that people read.
namespace pairsum::harness {

/// M for a table: "6", or "-" where the grid takes none.
std::string m_word(int M);

/// What tells the cells of a point: "M=6", or "compact_grid" where the grid takes no M.
std::string cells_word(const point& p);

/// "symmetric_omp M=6 threads=2", "tiles_omp compact_grid threads=2"; with its block unless that is auto or none.
std::string place_words(const point& p);

/// "symmetric_omp with M = 7 and 2 threads", "tiles_omp on compact_grid and 2 threads".
/// @param name the backend's, with what else tells it from others
std::string choice_words(const point& p, const std::string& name);

}  // namespace pairsum::harness
