// Pieces with buffers where they meet, oneTBB: the loop and why it is race-free stand in schedule/buffered_pieces.hpp.
#include <pairsum/schedule/buffered_pieces.hpp>

PAIRSUM_BACKEND(touched_blocks_tbb, buffered_pieces, tbb)
