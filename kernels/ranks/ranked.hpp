#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include <pairsum/sum/ghosts.hpp>
#include <pairsum/sum/summation.hpp>

namespace pairsum::ranks {

/// What was sent to other ranks: particles and rates, not what it takes to agree on who sends what.
struct traffic {
  std::uint64_t messages = 0, bytes = 0;
};

/// What makes the ranks' work equal when the domain is partitioned.
enum class balance {
  particles,  ///< their number
  pairs,      ///< the distance tests of the last index: candidates of each particle's cell
};

struct options {
  cut_pairs pairs = cut_pairs::twice;
  balance weights = balance::particles;
  int partition_every = 0;  ///< summations from one partition to the next; 0: one partition, after load()
  /// How much farther than H ghosts come from, in units of H, at least that of the backend's lists. The same ghosts
  /// serve until a particle has moved by half of it; 0: new ones for every sum.
  double skin = 0.1;
};

/// One rank's part of the summation evaluated last.
struct rank_facts {
  std::uint64_t own = 0, ghosts = 0, boundary = 0;  ///< particles
  std::uint64_t pairs = 0, cut = 0;                 ///< pairs that it sums, and those of them with a ghost
  traffic halo, migrate, send_back, partition;      ///< of this summation
};

/// A summation of which each rank of the job holds a part: the ranks call the same functions in the same order.
/// load() takes the whole table on every rank and keeps a part. index() gives ghosts their present values (refresh), or
/// moves particles that left a rank's box to their new rank (migrate) and copies what other ranks need (halo); reduce()
/// sends the rates of ghosts back in mode `once`. rates(), snapshot(), fingerprint(), lost(), not_finite() and
/// count_work() are those of all ranks, on every rank; count_work() counts each pair once. Each rank so needs room for
/// the whole table. `s` must be made for the
/// setup of the whole domain. Throws pairsum::error for `once` with a backend that sums one side of each pair.
std::unique_ptr<summation> make_ranked(std::unique_ptr<summation> s, const options& o);

/// The facts of every rank, by rank, on all of them; `s` as made by make_ranked(). After evaluate().
std::vector<rank_facts> facts_of(summation& s);

}  // namespace pairsum::ranks
