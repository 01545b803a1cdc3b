#pragma once
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <pairsum/core/workers.hpp>
#include <pairsum/grid/indexer.hpp>
#include <pairsum/sum/omega.hpp>
#include <pairsum/sum/schedule.hpp>
#include "library_formulas.hpp"

/// Which particles each unit of work of a backend writes to, found by running it on one thread and looking at the rates
/// between units, so whatever its lists and colours say of themselves.
namespace pairsum::test_kit {

/// Units of one pass, in their order: the particles each wrote to, ascending.
using written_by_unit = std::vector<std::vector<std::uint32_t>>;

/// Indexed particles with the formula `count`, whose candidates all interact, however far they are.
template <int D>
class counted_problem {
 public:
  counted_problem(const particle_set<D, double>& particles, const indexer<D, double>& index, const setup& s)
      : made_(counting_formula<D>().make(s)) {
    auto& counting = dynamic_cast<formula<D, double>&>(*made_);
    counting.derive(particles, index.fluid(), index.boundary(), team(), true);
    for (int d = 0; d < D; ++d) p.x.column[d] = particles.x[d].data();
    p.x.omega = make_torus<D, double>(s);
    p.grid_cells = &index.view();
    p.fluid_count = index.fluid();
    p.count = index.fluid() + index.boundary();
    counting.open(p, s.constants.H);
    p.reach2 = p.boundary_reach2 = std::numeric_limits<double>::max();
    p.pairs->zero(p.u, 0, p.fluid_count);
  }
  std::uint64_t neighbours(std::size_t i) const { return static_cast<const std::uint64_t*>(p.u.begin[0])[i]; }

  problem<D, double> p;

 private:
  std::unique_ptr<any_formula> made_;
};

/// Sees which rates changed, between looks.
template <int D>
class watched_rates {
 public:
  explicit watched_rates(const counted_problem<D>& of) : of_(of), before_(of.p.fluid_count, 0) {}
  /// Since the last look, ascending.
  std::vector<std::uint32_t> changed() {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < before_.size(); ++i)
      if (const std::uint64_t now = of_.neighbours(i); now != std::exchange(before_[i], now)) found.push_back(i);
    return found;
  }

 private:
  const counted_problem<D>& of_;
  std::vector<std::uint64_t> before_;
};

/// Wants to know of units, and of nothing else.
struct unit_observer : pass_observer {
  void pass_begins(unsigned) override {}
  void work_begins(unsigned, int) override {}
  void work_ends(unsigned, int) override {}
  void pass_ends(unsigned) override {}
  bool wants_units() const override { return true; }
};

/// Notes at the beginning of each unit what changed in the one before.
template <int D>
class unit_trace : public unit_observer {
 public:
  explicit unit_trace(const counted_problem<D>& p) : rates_(p) {}

  void unit_begins(unsigned pass, std::size_t k) override {
    close();
    numbers.push_back(k);
    open_ = &passes[pass].emplace_back();
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
  watched_rates<D> rates_;
  std::vector<std::uint32_t>* open_ = nullptr;
};

/// A backend's schedule.
template <int D>
std::unique_ptr<schedule<D, double>> schedule_of(const backend_entry& b, const setup& s) {
  auto made = cast<schedule<D, double>>(b.make(D, false));
  made->configure(s, 1000);
  return made;
}

/// What the units of a backend write to; `look(p, schedule, trace)` sees it.
template <int D, class Look>
void trace_units(const backend_entry& b, const particle_set<D, double>& particles, const indexer<D, double>& index,
                 const setup& s, Look&& look) {
  const counted_problem<D> counted(particles, index, s);
  const auto tried = schedule_of<D>(b, s);
  unit_trace<D> trace(counted);
  const workers one(b.traits.threads, 1);
  tried->prepare(counted.p, one.get());
  tried->sum(counted.p, one.get(), b.traits, pass_marks(&trace));
  trace.close();
  look(counted.p, *tried, trace);
}

/// The units of each pass.
template <int D>
std::map<unsigned, written_by_unit> units_of(const backend_entry& b, const particle_set<D, double>& particles,
                                             const indexer<D, double>& index, const setup& s) {
  std::map<unsigned, written_by_unit> passes;
  trace_units<D>(b, particles, index, s, [&](const auto&, const auto&, const auto& trace) { passes = trace.passes; });
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
