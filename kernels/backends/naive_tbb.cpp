// The gather, oneTBB: the loop and why it is race-free stand in schedule/gather_cells.hpp.
#include <pairsum/schedule/gather_cells.hpp>

PAIRSUM_BACKEND(naive_tbb, gather_cells, tbb)
