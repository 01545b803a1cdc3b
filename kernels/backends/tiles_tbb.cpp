// Coloured blocks of cells on vector units, oneTBB: the loop and why it is race-free stand in
// schedule/blocks_of_cells.hpp.
#include <pairsum/schedule/blocks_of_cells.hpp>

PAIRSUM_BACKEND(tiles_tbb, symmetric_tiles, tbb)
