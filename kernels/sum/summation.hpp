#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pairsum/core/pass_observer.hpp>
#include <pairsum/particles/particle_table.hpp>
#include <pairsum/sum/backend_traits.hpp>
#include <pairsum/sum/rate_table.hpp>
#include <pairsum/sum/setup.hpp>
#include <pairsum/sum/work_counts.hpp>

namespace pairsum {

/// One backend with one interaction on one set of particles, its types erased. It is called once per
/// summation, so the virtual call costs nothing. The phases must be called in their order; a caller may time each.
class summation {
 public:
  virtual ~summation() = default;

  virtual const backend_traits& traits() const = 0;

  /// Throws pairsum::error for particles that cannot be summed, see load().
  virtual void check(const particle_table& p) const = 0;

  /// Takes the particles (ids are row numbers) in the given order of memory (empty: id order). Positions must be finite
  /// and in Omega, masses and densities positive; else an error that says which particle, or how many, and changes
  /// nothing.
  void load(const particle_table& p, const std::vector<std::uint32_t>& order) { load(p, order, team()); }
  /// The same, written by the threads of the team that will sum (first touch).
  virtual void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) = 0;

  virtual void index(const team& t) = 0;    ///< cell keys, sort, reorder, cell ranges, neighbour table
  virtual void prepare(const team& t) = 0;  ///< per-particle terms of the formula, the backend's workspace
  virtual void zero(const team& t) = 0;     ///< rates to 0, for backends that accumulate
  virtual void sum(const team& t) = 0;      ///< the summation
  virtual void reduce(const team& t) = 0;   ///< adds up private copies, for backends that have them

  /// From now on sum() marks its passes for this observer, if the backend has passes; nullptr: for none.
  virtual void observe(pass_observer* observer) = 0;

  /// All phases once.
  void evaluate(const team& t) {
    index(t);
    prepare(t);
    zero(t);
    sum(t);
    reduce(t);
  }

  /// The work of a summation of the state as indexed last; an untimed run of its own, on one thread.
  virtual work_counts count_work() = 0;

  /// The blocks of cells that the backend made of the state as prepared last, as a word of block_shape; "none" for
  /// backends without.
  virtual std::string block() const = 0;
  virtual std::size_t lanes() const = 0;     ///< pairs that are evaluated at a time
  virtual std::string_view isa() const = 0;  ///< instruction set of the vector units that it runs on, or "scalar"

  /// The distance tests a grid that folds nothing would need for the state as loaded or indexed last; empty if the
  /// precision does not resolve H in an Omega of that size.
  virtual std::optional<unfolded_tests> count_unfolded_tests() const = 0;

  virtual rate_table rates() const = 0;
  /// 64-bit hash of the rates' bytes in id order: equal for bit-identical rates, whatever the order of memory.
  virtual std::uint64_t fingerprint() const = 0;
  virtual particle_table snapshot() const = 0;
  /// Particles that have left Omega since load().
  virtual std::size_t lost() const = 0;
  /// Ids of particles with a position, velocity or density that is not finite, ascending.
  virtual std::vector<std::uint32_t> not_finite() const = 0;

  /// The summation that holds the particles, for integrators: one that wraps another names that.
  virtual summation& holder() { return *this; }
};

}  // namespace pairsum
