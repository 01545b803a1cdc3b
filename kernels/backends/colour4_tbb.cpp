// Packs of base blocks in 4 colours, oneTBB: the loop and why it is race-free stand in schedule/block_packs.hpp.
#include <pairsum/schedule/block_packs.hpp>

PAIRSUM_BACKEND(colour4_tbb, block_packs, tbb)
