#pragma once
#include <string>
#include <vector>

namespace pairsum::harness {

/// Where a rank may run.
struct rank_seat {
  std::string host;
  std::vector<int> units;  ///< processing units in the order threads take them; empty: nothing is bound
  int cores = 1;           ///< threads that it may have at the same time
  bool operator==(const rank_seat&) const = default;
};

/// Which of its units each rank's threads take.
struct placement {
  std::vector<std::size_t> first;  ///< by rank: thread k of it takes unit first + k
  std::string why_untimed;         ///< why times would say little; empty if every thread has a core of its own
};

/// Ranks of a host that may run on the same units share these out, in their order; those with units of their own keep
/// them.
placement place(const std::vector<rank_seat>& seats, int threads);

/// The units of a rank's threads as a text, "0,1"; "any" where nothing is bound.
std::string units_text(const rank_seat& seat, std::size_t first, int threads);

}  // namespace pairsum::harness
