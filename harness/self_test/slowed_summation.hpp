#pragma once
#include "harness/measure/stopwatch.hpp"
#include "harness/self_test/forwarding_summation.hpp"

namespace pairsum::harness {

/// Takes longer by a known share: after each sum the calling thread waits, busily, that share of the time which the sum
/// took by the steady clock.
class slowed_summation final : public forwarding_summation {
 public:
  slowed_summation(std::unique_ptr<summation> inner, std::string_view name, std::string_view description, double share)
      : forwarding_summation(std::move(inner), name, description), share_(share) {}

  void sum(const team& t) override {
    const stopwatch watch;
    forwarding_summation::sum(t);
    const double until = watch.seconds() * (1 + share_);
    while (watch.seconds() < until) {
    }
  }

 private:
  double share_;
};

}  // namespace pairsum::harness
