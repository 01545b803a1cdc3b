// The gather over blocks of cells on vector units, OpenMP: the loop and why it is race-free stand in
// schedule/blocks_of_cells.hpp.
#include <pairsum/schedule/blocks_of_cells.hpp>

PAIRSUM_BACKEND(naive_tiles_omp, gather_tiles, omp)
