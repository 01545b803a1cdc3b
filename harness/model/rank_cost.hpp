#pragma once
#include <array>
#include <span>

#include "harness/model/link.hpp"

namespace pairsum::harness {

/// One of the equal boxes into which ranks cut a periodic domain that a simple cubic lattice fills. Faces lie in the
/// middle between layers of particles.
struct lattice_box {
  std::array<int, 3> particles{1, 1, 1};  ///< of one rank, along each axis
  std::array<int, 3> ranks{1, 1, 1};      ///< of the domain, along each axis
  double dx = 1;                          ///< spacing, m
  double H = 2;                           ///< cutoff, m
  double skin = 0;                        ///< how much farther than H ghosts come from, m
};

/// What one rank holds and sums.
struct rank_share {
  double own = 0, ghosts = 0;  ///< particles
  double inner = 0;            ///< pairs of two own particles
  double cut = 0;              ///< pairs of an own particle and a ghost, whichever rank sums them
  double neighbours = 0;       ///< ranks whose particles are its ghosts
};

/// Exact for particles on the lattice, by counting offsets o between them. A pair interacts if |o| dx < H. Along an
/// axis with several ranks, n - |o| of n layers have their partner in the same box. Ghosts are the full shell: all
/// layers within H + skin of the box, with edges and corners. Distances equal to either but for rounding count as it.
/// Throws pairsum::error for numbers that are not positive (the skin may be 0), and for a domain narrower than 3 H.
rank_share counted_share(const lattice_box& box);

/// The mean for particles of number density 1 / dx^3 whose places do not depend on each other. Of the pairs at offset r
/// a rank's box of edges L keeps prod(1 - |r_d| / L_d) over the axes d that are cut. Means over the ball of radius H:
/// |r_x| 3 H / 8, |r_x r_y| 2 H^2 / (5 pi), |r_x r_y r_z| H^3 / (8 pi).
/// Throws like counted_share, and for a cut axis along which the box is narrower than H.
rank_share mean_share(const lattice_box& box);

/// Who sums a pair of particles of two ranks.
enum class cut_mode {
  twice,  ///< both ranks, each for its own particle; no rates are sent
  once,   ///< one of them; it sends the other's rate back: half of the cut pairs, a second set of messages
};

/// The time of one particle, own or ghost, and of one pair, s.
struct unit_costs {
  double s_per_particle = 0, s_per_pair = 0;
};

/// What a ghost needs in messages.
struct ghost_bytes {
  double particle = 0;  ///< its present values; its whole record in an evaluation for which new ghosts come
  double rates = 0;     ///< sent back in mode `once`
};

/// What a rank sends for one evaluation.
struct rank_traffic {
  double messages = 0, bytes = 0;
};
rank_traffic traffic_of(const rank_share& rank, const ghost_bytes& bytes, cut_mode mode);

/// Pairs that a rank sums; of the cut ones, its part in the mean.
double pairs_summed(const rank_share& rank, cut_mode mode);

/// The time of one evaluation, s: the most work of a rank, and the most time for its messages, each of which takes the
/// latency, and their bytes the bandwidth. No message overlaps with work or with another of the same rank.
/// Throws pairsum::error without ranks and for costs, bytes and links that are negative or not finite.
double evaluation_s(std::span<const rank_share> ranks, const unit_costs& costs, const ghost_bytes& bytes,
                    const link_rates& link, cut_mode mode);

}  // namespace pairsum::harness
