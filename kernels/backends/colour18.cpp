// Half stencils in 18 colours, OpenMP: the loop and why it is race-free stand in schedule/half_stencil_colours.hpp.
#include <pairsum/schedule/half_stencil_colours.hpp>

PAIRSUM_BACKEND(colour18, half_stencil_colours, omp)
