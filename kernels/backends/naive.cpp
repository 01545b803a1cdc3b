// The gather, one thread: the loop and why it is race-free stand in schedule/gather_cells.hpp.
#include <pairsum/schedule/gather_cells.hpp>

PAIRSUM_BACKEND(naive, gather_cells, serial)
