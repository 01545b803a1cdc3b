#pragma once
#include <cstdint>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/ranks/exchange.hpp>
#include <pairsum/ranks/near_boxes.hpp>
#include <pairsum/ranks/partition.hpp>
#include <pairsum/sum/state.hpp>

namespace pairsum::ranks {

/// One rank's particles: those in its box, which it owns, and ghosts, those of other ranks within reach of the box. The
/// box reaches through periodic faces, too. Boundary, which never moves, is copied to all ranks within reach.
///
///   +-----------+- - -+-----------+     own particles o, ghosts g: an own particle near the
///   | rank 0   o|     |g          |     face is a ghost of the rank beyond it
///   |          g|     |o   rank 1 |
///   +-----------+- - -+-----------+
///
/// All functions are collective: every rank calls them in the same order.
template <int D, class R>
class domain {
 public:
  /// `s` is this rank's part; `reach`: how far pairs reach, m; `skin`: how much farther ghosts come from, m. They serve
  /// until a particle has moved by half of the skin.
  domain(state<D, R>& s, double reach, double skin);

  /// Takes this rank's share of a checked table, in the given order of memory (empty: id order), and partitions.
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, balance weights);
  /// Cuts the domain anew, into boxes of equal weight, and moves particles to their new owners.
  void cut(balance weights);
  /// What comes before each index: refresh(), or, if that is not enough any more, migrate() and halo().
  void update();
  /// Moves particles that left the box to their new owners.
  void migrate() {
    wrap(state_.particles(), fluid_);
    move_to_owners(migrated_);
  }
  /// Copies particles within reach of other ranks' boxes to them; forgets the ghosts of before.
  void halo();
  /// Gives the ghosts their owners' present positions, velocities and densities.
  void refresh();
  /// Adds the rates of ghosts to those of their owners. After the sum of the particles as indexed.
  void send_back();

  /// Of this rank, since the last call: what was sent by each of the functions above.
  rank_facts sent();
  std::uint64_t own() const { return own_; }
  std::uint64_t ghosts() const { return exchange_.received(); }

 private:
  void wrap(particle_set<D, R>& p, std::size_t n) const;
  /// After an index, which puts lost particles behind all others.
  void count_fluid();
  void move_to_owners(traffic& count);
  void copy_boundary(traffic& count);
  /// The fluid shrinks to `keep` and gets `records` behind it.
  void replace_fluid(const std::vector<std::uint32_t>& keep, const std::vector<std::byte>& records, bool ghosts);
  /// Is a particle lost, or has one moved by more than half of the skin, here or elsewhere?
  bool has_moved() const;
  /// Where the particles are that were sent, and the ghosts.
  void find_places();

  state<D, R>& state_;
  box<D, R> omega_;
  torus<D, R> torus_;
  double skin_;
  partition partition_;
  near_boxes near_;
  particle_set<D, R> home_;  ///< this rank's share of the boundary, whoever needs copies
  std::size_t fluid_ = 0;    ///< own and ghosts at the front of the set
  std::size_t own_ = 0;
  exchange exchange_;                                      ///< of the last halo
  std::vector<std::uint32_t> halo_ids_, ghost_ids_;        ///< of the particles sent and received, in its order
  std::vector<std::uint32_t> halo_places_, ghost_places_;  ///< where they were last
  traffic partitioned_, migrated_, haloed_, sent_back_;
};

#define PAIRSUM_DOMAINS(D, R) extern template class domain<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_DOMAINS)
#undef PAIRSUM_DOMAINS

}  // namespace pairsum::ranks
