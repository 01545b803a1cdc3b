// Half stencils in 18 colours, oneTBB: the loop and why it is race-free stand in schedule/half_stencil_colours.hpp.
#include <pairsum/schedule/half_stencil_colours.hpp>

PAIRSUM_BACKEND(colour18_tbb, half_stencil_colours, tbb)
