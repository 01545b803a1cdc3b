#include "harness/ranks/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace pairsum::harness {
namespace {

/// What gives each rank its own cores, in the words of those who start it.
constexpr const char* cure = "mpirun --bind-to none, or srun --cpus-per-task={} --cpu-bind=cores, gives each its own";

std::string threads_text(int threads) { return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"); }

/// Does any unit belong to several of these ranks?
bool overlap(const std::vector<rank_seat>& seats, const std::vector<std::size_t>& ranks) {
  std::set<int> seen;
  for (const std::size_t r : ranks)
    for (const int u : seats[r].units)
      if (!seen.insert(u).second) return true;
  return false;
}

/// Why the ranks of one host cannot be timed.
std::string why_not(const std::vector<rank_seat>& seats, const std::vector<std::size_t>& ranks, int threads,
                    bool share) {
  const rank_seat& any = seats[ranks.front()];
  const auto wanted = static_cast<long>(ranks.size()) * threads;
  if (share) {
    const bool alike = std::ranges::all_of(ranks, [&](std::size_t r) { return seats[r].units == any.units; });
    if (!alike)
      return fmt::format("some ranks on {} share cores, others do not: ", any.host) +
             fmt::format(fmt::runtime(cure), threads);
    if (wanted <= any.cores) return "";
    return fmt::format("{} ranks with {} each on {} core{} of {}", ranks.size(), threads_text(threads), any.cores,
                       any.cores == 1 ? "" : "s", any.host);
  }
  for (const std::size_t r : ranks)
    if (threads > seats[r].cores)
      return fmt::format("rank {} has {} on {} core{} of {}: ", r, threads_text(threads), seats[r].cores,
                         seats[r].cores == 1 ? "" : "s", any.host) +
             fmt::format(fmt::runtime(cure), threads);
  return "";
}

}  // namespace

placement place(const std::vector<rank_seat>& seats, int threads) {
  placement p;
  p.first.assign(seats.size(), 0);
  std::map<std::string, std::vector<std::size_t>> hosts;
  for (std::size_t r = 0; r < seats.size(); ++r) hosts[seats[r].host].push_back(r);
  for (const auto& [host, ranks] : hosts) {
    const bool free = seats[ranks.front()].units.empty(), share = free || overlap(seats, ranks);
    if (share)
      for (std::size_t k = 0; k < ranks.size(); ++k) p.first[ranks[k]] = k * static_cast<std::size_t>(threads);
    if (p.why_untimed.empty()) p.why_untimed = why_not(seats, ranks, threads, share);
  }
  return p;
}

std::string units_text(const rank_seat& seat, std::size_t first, int threads) {
  if (seat.units.empty()) return "any";
  std::set<int> taken;
  for (std::size_t k = 0; k < static_cast<std::size_t>(threads); ++k)
    taken.insert(seat.units[(first + k) % seat.units.size()]);
  return fmt::format("{}", fmt::join(taken, ","));
}

}  // namespace pairsum::harness
