// The talk's passes on half cells, oneTBB: the loop and why it is race-free stand in schedule/half_cell_blocks.hpp.
#include <pairsum/schedule/half_cell_blocks.hpp>

PAIRSUM_BACKEND(half_cells_tbb, half_cell_blocks, tbb)
