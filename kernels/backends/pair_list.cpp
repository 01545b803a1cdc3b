// The list of pairs, swept by, one thread: the loop and why it is race-free stand in schedule/row_lists.hpp.
#include <pairsum/schedule/row_lists.hpp>

PAIRSUM_BACKEND(pair_list, row_after_row, serial)
