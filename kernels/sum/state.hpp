#pragma once
#include <array>

#include <pairsum/core/places.hpp>
#include <pairsum/grid/indexer.hpp>
#include <pairsum/sum/formula.hpp>
#include <pairsum/sum/ghosts.hpp>
#include <pairsum/sum/summation.hpp>

namespace pairsum {

/// Columns of rates: of particle i element i of each, `bytes` wide.
struct rate_columns {
  rate_view view;
  std::span<const std::uint16_t> bytes;
  /// to[to_at + k] += from[from_at + k] for k < n
  void (*add)(const rate_view& to, std::size_t to_at, const rate_view& from, std::size_t from_at, std::size_t n);
};

/// A summation whose particles are known to be D-dimensional in precision R: all that does not depend on the formula or
/// the backend, and what integrators work on.
template <int D, class R>
class state : public summation {
 public:
  virtual dynamics<D, R> rates_of_state() const = 0;

  void check(const particle_table& p) const override;
  using summation::load;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) override;
  void index(const team& t) override;
  void observe(pass_observer* observer) override { observer_ = observer; }
  std::optional<unfolded_tests> count_unfolded_tests() const override;
  particle_table snapshot() const override;
  std::size_t lost() const override { return lost_; }
  std::vector<std::uint32_t> not_finite() const override;

  /// Callers that move boundary particles, or change the order of any, must call forget_index().
  particle_set<D, R>& particles() { return particles_; }
  void forget_index() { index_.forget(); }
  /// Says that there may be ghosts in the set, and who sums their pairs. Throws pairsum::error for `once` with a
  /// backend that sums one side of each pair.
  void sum_ghosts(cut_pairs pairs);
  /// Takes rows `ids` of a checked table, which has rows for other ranks' particles, too; the order of memory is
  /// theirs.
  void load_some(const particle_table& p, const std::vector<std::uint32_t>& ids);
  /// Fluid particles are the first of the set after index().
  std::size_t fluid_count() const { return index_.fluid(); }
  std::size_t boundary_count() const { return index_.boundary(); }
  const cells<D>& view() const { return index_.view(); }
  const setup& settings() const { return setup_; }
  /// The fluid's rates, a column per scalar, and how they are added to.
  virtual rate_columns columns_of_rates() const = 0;

 protected:
  /// skin: how much wider cells are for Verlet lists, in units of H.
  explicit state(const setup& s, double skin = 0);
  ~state() override;

  setup setup_;
  particle_set<D, R> particles_;
  indexer<D, R> index_;
  std::size_t rows_total_ = 0, lost_ = 0;
  pass_observer* observer_ = nullptr;
  ghost_marks ghosts_;
};

#define PAIRSUM_STATES(D, R) extern template class state<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_STATES)
#undef PAIRSUM_STATES

}  // namespace pairsum
