#pragma once
#include <memory>
#include <span>

#include <pairsum/particles/particle_set.hpp>
#include <pairsum/sum/lane_rows.hpp>
#include <pairsum/sum/problem.hpp>
#include <pairsum/sum/rate_table.hpp>
#include <pairsum/sum/reference.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// Columns of the rates that an integrator uses, in the order of the particles; empty if the interaction has none.
template <int D, class R>
struct dynamics {
  const R* drho = nullptr;
  std::array<const R*, D> dv{};
  explicit operator bool() const { return drho != nullptr; }
};

/// A formula on the vector units of one instruction set.
template <int D, class R>
struct lane_sum {
  std::string_view isa;
  std::size_t lanes;  ///< pairs in a vector
  bool fuses;         ///< rounds a*b + c once
  pair_sum<D, R> pairs;
  /// Copies the rates of rows to columns.
  void (*to_columns)(const rate_view& rows, const rate_view& columns, std::size_t begin, std::size_t end) = nullptr;
};

struct any_formula {
  virtual ~any_formula() = default;
};

/// An interaction with its smoothing kernel, and columns for the data of particles and for their rates: what the rest
/// of the library sees of it.
template <int D, class R>
class formula : public any_formula {
 public:
  /// Throws pairsum::error for particles that it cannot sum.
  virtual void check(const particle_table&, const setup&) const {}
  /// Derives what boundary [fluid, fluid + boundary) and, unless rows are filled instead, fluid [0, fluid) need.
  virtual void derive(const particle_set<D, R>& p, std::size_t fluid, std::size_t boundary, const team& t,
                      bool with_fluid) = 0;
  /// Lets the problem point to the formula, its columns and its scalar functions; sets the cutoff of the boundary.
  virtual void open(problem<D, R>& p, R H) = 0;
  /// On columns. In precision mixed, whose pairs are for vector units alone, none of the functions on rows.
  virtual const pair_sum<D, R>& scalar() const = 0;
  /// Those that were compiled and that this machine runs, best first; none for formulas with whole numbers.
  virtual std::span<const lane_sum<D, R>> lanes() const = 0;
  virtual lane_layout layout() const = 0;
  /// Derives what fluid particles [begin, end) bring into the rows of vector units.
  virtual void fill(const particle_set<D, R>& p, const lane_view<D, R>& to, std::size_t begin,
                    std::size_t end) const = 0;

  /// Rates of the first n particles, by id, in a table of `rows` rows.
  virtual rate_table rates(std::span<const std::uint32_t> id, std::size_t n, std::size_t rows) const = 0;
  /// 64-bit hash of the rates' bytes of particles `place[0], place[1], ...`.
  virtual std::uint64_t fingerprint(std::span<const std::uint32_t> place) const = 0;
  virtual dynamics<D, R> rates_of_state() const = 0;
};

/// The words of a formula, which live for ever.
struct combination_words {
  std::string_view interaction, smoothing;  ///< smoothing is "" where the interaction uses none
  int dim;
  std::string_view precision;
};

/// A formula of a registry. formula/entry.hpp makes it: formula_entry_of<I>().
struct formula_entry {
  combination_words words;
  std::unique_ptr<any_formula> (*make)(
      const setup&);  ///< formula<dim, precision float ? float : double>; nullptr: none
  std::unique_ptr<reference> (*oracle)(const setup&);
};

}  // namespace pairsum
