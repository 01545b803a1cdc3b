#pragma once
#include <algorithm>
#include <cmath>
#include <memory>

#include "broken_registry.hpp"

// Backends and references that are right in all but one claim, to show that verification finds that one.
namespace pairsum {

/// Right rates, but says that it summed one fluid pair more than it did.
template <int D, class R>
struct counts_one_too_many : broken_none<D, R> {
  void sum(const problem<D, R>& p, const team& t, const backend_traits& own, const pass_marks& marks) override {
    broken_none<D, R>::sum(p, t, own, marks);
    if (p.counts != nullptr) ++p.counts->pairs_fluid_fluid;
  }
};

/// Rates within their bounds, but the last bit of one depends on the number of threads, whatever it claims.
template <bool Claims, int D, class R>
struct bits_change_with_threads : broken_none<D, R> {
  static constexpr backend_traits traits = [] {
    backend_traits t = broken_none<D, R>::traits;
    t.deterministic = Claims;
    return t;
  }();
  void sum(const problem<D, R>& p, const team& t, const backend_traits& own, const pass_marks& marks) override {
    broken_none<D, R>::sum(p, t, own, marks);
    if (t.threads() == 1 || p.counts != nullptr) return;
    R* const drho = static_cast<R*>(p.u.begin[0]);
    R* const first = std::find_if(drho, drho + p.fluid_count, [](R a) { return a != 0; });
    if (first != drho + p.fluid_count) *first = std::nextafter(*first, 2 * *first);
  }
};
template <int D, class R>
using claims_equal_bits = bits_change_with_threads<true, D, R>;
template <int D, class R>
using admits_other_bits = bits_change_with_threads<false, D, R>;

/// Right, but in the third sum it makes: with two stages a step, the first stage of the second step.
template <int D, class R>
struct wrong_in_third_sum : broken_none<D, R> {
  int sums = 0;
  void sum(const problem<D, R>& p, const team& t, const backend_traits& own, const pass_marks& marks) override {
    broken_none<D, R>::sum(p, t, own, marks);
    if (++sums == 3) p.pairs->add(p.u, 0, p.u, 0, p.fluid_count);
  }
};

inline registry lying_registry() {
  registry r;
  r.add(test_kit::ferrari09_3d());
  r.add(backend_entry::of<counts_one_too_many>("counts_one_too_many", runtime::serial));
  r.add(backend_entry::of<wrong_in_third_sum>("wrong_in_third_sum", runtime::serial));
  r.add(backend_entry::of<claims_equal_bits>("claims_equal_bits", runtime::omp));
  r.add(backend_entry::of<admits_other_bits>("admits_other_bits", runtime::omp));
  return r;
}

/// The true reference, but its cell search is off by `off` bounds at every particle.
class contradicts_itself final : public reference {
 public:
  contradicts_itself(std::unique_ptr<reference> right, double off) : right_(std::move(right)), off_(off) {}

  expectation brute_force(const particle_table& p, const team& t, std::vector<std::uint32_t> ids) const override {
    return right_->brute_force(p, t, std::move(ids));
  }
  expectation cell_search(const particle_table& p, const team& t) const override {
    expectation e = right_->cell_search(p, t);
    for (std::size_t c = 0; c < e.value.size(); ++c)
      for (std::size_t k = 0; k < e.ids.size(); ++k) e.value[c][k] += off_ * e.bound[c][k];
    return e;
  }

  formula_costs costs() const override { return right_->costs(); }

 private:
  std::unique_ptr<reference> right_;
  double off_;
};

inline registry registry_with_reference_off_by(double off) {
  static double current = 0;  // a maker is a plain function
  current = off;
  registry r;
  r.add(formula_entry{
      {"ferrari09", "wendland_c2", 3, "double"}, nullptr, [](const setup& s) -> std::unique_ptr<reference> {
        return std::make_unique<contradicts_itself>(registry::instance().make_reference(s), current);
      }});
  return r;
}

}  // namespace pairsum
