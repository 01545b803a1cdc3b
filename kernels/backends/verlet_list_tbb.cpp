// Lists with a skin that are kept, oneTBB: the loop and why it is race-free stand in schedule/kept_lists.hpp.
#include <pairsum/schedule/kept_lists.hpp>

PAIRSUM_BACKEND(verlet_list_tbb, kept_lists, tbb)
