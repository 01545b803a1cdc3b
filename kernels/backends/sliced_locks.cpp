// A slab per thread, a lock where two meet, OpenMP: the loop and why it is race-free stand in
// schedule/locked_slabs.hpp.
#include <pairsum/schedule/locked_slabs.hpp>

PAIRSUM_BACKEND(sliced_locks, locked_slabs, omp)
