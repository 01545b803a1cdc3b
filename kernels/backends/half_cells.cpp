// The talk's passes on half cells, OpenMP: the loop and why it is race-free stand in schedule/half_cell_blocks.hpp.
#include <pairsum/schedule/half_cell_blocks.hpp>

PAIRSUM_BACKEND(half_cells, half_cell_blocks, omp)
