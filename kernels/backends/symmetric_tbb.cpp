// The talk's passes, oneTBB: the loop and why it is race-free stand in schedule/base_blocks.hpp.
#include <pairsum/schedule/base_blocks.hpp>

PAIRSUM_BACKEND(symmetric_tbb, base_blocks, tbb)
