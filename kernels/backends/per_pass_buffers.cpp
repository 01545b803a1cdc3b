// The talk's passes without barriers, OpenMP: the loop and why it is race-free stand in schedule/pass_buffers.hpp.
#include <pairsum/schedule/pass_buffers.hpp>

PAIRSUM_BACKEND(per_pass_buffers, pass_buffers, omp)
