// The list of pairs in coloured blocks, oneTBB: the loop and why it is race-free stand in schedule/row_lists.hpp.
#include <pairsum/schedule/row_lists.hpp>

PAIRSUM_BACKEND(pair_list_tbb, row_lists, tbb)
