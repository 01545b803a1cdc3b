// The talk's passes, one thread: the loop and why it is race-free stand in schedule/base_blocks.hpp.
#include <pairsum/schedule/base_blocks.hpp>

PAIRSUM_BACKEND(symmetric, base_blocks, serial)
