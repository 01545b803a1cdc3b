#pragma once
#include "sum/block.hpp"
#include "sum/gather_cell.hpp"
#include "sum/interaction_state.hpp"
#include "sum/pair_rows.hpp"
#include "sum/scatter_cell.hpp"

/// What the backends have in common for one interaction: compiled once, in the file that says PAIRSUM_SHARE(, I), and
/// only declared, by PAIRSUM_SHARE(extern, I), where backends are. Without it every backend compiles its own copy.
#define PAIRSUM_SHARE(EXTERN, ...)                                                                                   \
  EXTERN template class interaction_columns<__VA_ARGS__>;                                                            \
  EXTERN template class interaction_state<__VA_ARGS__>;                                                              \
  EXTERN template void scatter_cell<__VA_ARGS__, no_probe>(const problem<__VA_ARGS__>&, std::size_t, no_probe&);     \
  EXTERN template void sum_row<__VA_ARGS__, no_probe>(const problem<__VA_ARGS__>&, const pair_rows&, std::size_t,    \
                                                      no_probe&);                                                    \
  EXTERN template void gather_cell<__VA_ARGS__, no_probe>(const problem<__VA_ARGS__>&, std::size_t, no_probe&);      \
  EXTERN template void sum_block<__VA_ARGS__, no_probe>(const problem<__VA_ARGS__>&, const block<__VA_ARGS__::dim>&, \
                                                        no_probe&);
