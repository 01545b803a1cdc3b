// The talk's passes, OpenMP: the loop and why it is race-free stand in schedule/base_blocks.hpp.
#include <pairsum/schedule/base_blocks.hpp>

PAIRSUM_BACKEND(symmetric_omp, base_blocks, omp)
