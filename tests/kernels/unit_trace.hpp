#pragma once
#include <limits>
#include <map>
#include <vector>

#include "interactions/count.hpp"
#include "sum/summation_of.hpp"

/// Which particles each unit of work of a backend writes to, found by running it on one thread and looking at the rates
/// between units, so whatever its lists and colours say of themselves.
namespace pairsum::test_kit {

/// Units of one pass, in their order: the particles each wrote to, ascending.
using written_by_unit = std::vector<std::vector<std::uint32_t>>;

/// Sees which entries of a column of rates changed, between looks.
template <class I>
class watched_rates {
 public:
  watched_rates(const field_pointers<rates_of<I>>& u, std::size_t n) : u_(u), before_(n) {
    for (std::size_t i = 0; i < n; ++i) before_[i] = u_.load(i).neighbours;
  }
  /// Since the last look, ascending.
  std::vector<std::uint32_t> changed() {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < before_.size(); ++i) {
      const std::uint64_t now = u_.load(i).neighbours;
      if (now != before_[i]) found.push_back(i);
      before_[i] = now;
    }
    return found;
  }

 private:
  field_pointers<rates_of<I>> u_;
  std::vector<std::uint64_t> before_;
};

/// Notes at the beginning of each unit what changed in the one before.
template <class I>
class unit_trace : public no_probe {
 public:
  explicit unit_trace(const problem<I>& p) : rates_(p.u, p.fluid_count) {}

  void unit_begins(unsigned pass, std::size_t k) {
    close();
    numbers.push_back(k);
    passes[pass].emplace_back();
    open_ = &passes[pass].back();
  }
  /// To be called after the sum.
  void close() {
    const std::vector<std::uint32_t> changed = rates_.changed();
    if (open_ != nullptr) *open_ = changed;
    open_ = nullptr;
  }

  std::map<unsigned, written_by_unit> passes;
  std::vector<std::size_t> numbers;  ///< of all units, as they came

 private:
  watched_rates<I> rates_;
  std::vector<std::uint32_t>* open_ = nullptr;
};

/// What the units of backend B write to when all candidates interact, however far they are; `look(p, workspace, trace)`
/// sees it.
template <class B, int D, class Look>
void trace_units(const particle_set<D, double>& particles, const indexer<D, double>& index, const setup& s,
                 Look&& look) {
  using I = count<D, double>;
  interaction_columns<I> columns(s.constants, make_torus<D, double>(s));
  const team alone;
  columns.derive(particles, index.fluid(), index.boundary(), alone);
  columns.zero_rates(alone);
  problem<I> p = columns.view(particles, index.view());
  p.reach2 = p.boundary_reach2 = std::numeric_limits<double>::max();
  typename B::template workspace<I> workspace;
  configure(workspace, s);
  unit_trace<I> trace(p);
  with_one_thread(B::traits.threads, [&](const team& one) {
    workspace.prepare(p, one, trace);
    workspace.sum(p, one, trace);
  });
  trace.close();
  look(p, workspace, trace);
}

/// The units of each pass.
template <class B, int D>
std::map<unsigned, written_by_unit> units_of(const particle_set<D, double>& particles, const indexer<D, double>& index,
                                             const setup& s) {
  std::map<unsigned, written_by_unit> passes;
  trace_units<B, D>(particles, index, s, [&](const auto&, const auto&, const auto& trace) { passes = trace.passes; });
  return passes;
}

/// Particles that two units of a pass write to.
inline std::size_t conflicts_in(const written_by_unit& pass, std::size_t fluid) {
  std::vector<int> writers(fluid, 0);
  std::size_t n = 0;
  for (const auto& unit : pass)
    for (const std::uint32_t i : unit) n += ++writers[i] == 2;
  return n;
}

}  // namespace pairsum::test_kit
