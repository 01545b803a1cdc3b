// Slabs in two colours, oneTBB: the loop and why it is race-free stand in schedule/slabs_of_two_colours.hpp.
#include <pairsum/schedule/slabs_of_two_colours.hpp>

PAIRSUM_BACKEND(sliced_2colour_tbb, slabs_of_two_colours, tbb)
