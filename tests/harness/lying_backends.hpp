#pragma once
#include <cmath>
#include <memory>

#include "broken_registry.hpp"

// Backends and references that are right in all but one claim, to show that verification finds that one.
namespace pairsum {

/// Right rates, but says that it summed one fluid pair more than it did.
struct counts_one_too_many {
  static constexpr backend_traits traits = [] {
    backend_traits t = broken_symmetric<fault::none>::traits;
    t.name = "counts_one_too_many";
    return t;
  }();

  template <class I>
  struct workspace : broken_symmetric<fault::none>::workspace<I> {
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      broken_symmetric<fault::none>::workspace<I>::sum(p, t, probe);
      probe.fluid_pairs(1);
    }
  };
};

/// Rates within their bounds, but the last bit of one depends on the number of threads, whatever it claims.
template <bool Claims>
struct bits_change_with_threads {
  static constexpr backend_traits traits = [] {
    backend_traits t = broken_symmetric<fault::none>::traits;
    t.name = Claims ? "claims_equal_bits" : "admits_other_bits";
    t.threads = runtime::omp;
    t.deterministic = Claims;
    return t;
  }();

  template <class I>
  struct workspace : broken_symmetric<fault::none>::workspace<I> {
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      broken_symmetric<fault::none>::workspace<I>::sum(p, t, probe);
      bool nudged = t.threads() == 1;
      for (std::size_t i = 0; i < p.fluid_count && !nudged; ++i) {
        auto u = p.u.load(i);
        each_scalar(u, [&](auto& a, int) {
          if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(a)>>) {
            if (nudged || a == 0) return;
            a = std::nextafter(a, 2 * a);
            nudged = true;
          }
        });
        p.u.store(i, u);
      }
    }
  };
};

/// Right, but in the third sum it makes: with two stages a step, the first stage of the second step.
struct wrong_in_third_sum {
  static constexpr backend_traits traits = [] {
    backend_traits t = broken_symmetric<fault::none>::traits;
    t.name = "wrong_in_third_sum";
    return t;
  }();

  template <class I>
  struct workspace : broken_symmetric<fault::none>::workspace<I> {
    int sums = 0;
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      broken_symmetric<fault::none>::workspace<I>::sum(p, t, probe);
      if (++sums == 3)
        for (std::size_t i = 0; i < p.fluid_count; ++i) p.u.add(i, p.u.load(i));
    }
  };
};

inline registry lying_registry() {
  using formula = ferrari09<3, double, wendland_c2>;
  registry r;
  enrol_oracle<formula>(r);
  const auto add = [&]<class Backend>() {
    r.enrol_backend(Backend::traits);
    enrol_summation<Backend, formula>(r);
  };
  add.template operator()<counts_one_too_many>();
  add.template operator()<wrong_in_third_sum>();
  add.template operator()<bits_change_with_threads<true>>();
  add.template operator()<bits_change_with_threads<false>>();
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
  r.enrol_reference({"ferrari09", "wendland_c2", 3, "double"}, [](const setup& s) -> std::unique_ptr<reference> {
    return std::make_unique<contradicts_itself>(registry::instance().make_reference(s), current);
  });
  return r;
}

}  // namespace pairsum
