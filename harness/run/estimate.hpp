#pragma once
#include <vector>

#include "harness/plan/study.hpp"

namespace pairsum::harness {

/// How long the parts of a plan will take: from the particles, steps and threads of their points and a rate, which is
/// a guess until something was measured. For the line on the terminal, the dry run and the budget; never for a result.
class estimate {
 public:
  estimate(const study_plan& plan, const registry& all);

  /// Measures the rate by a small sum on this machine (a second at most).
  void calibrate(const registry& all);

  double peaks_s() const { return peaks_s_; }
  double verify_s(std::size_t part) const { return parts_[part].verify_s.value_or(verify_factor * work_s(part)); }
  double round_s(std::size_t part) const { return parts_[part].round_s.value_or(round_factor * work_s(part)); }
  /// Everything, as far as the budget lets it.
  double all_s() const;

  /// What was seen of a part; the others' estimates follow.
  void verified(std::size_t part, double seconds);
  void measured(std::size_t part, double seconds);

  std::size_t points(std::size_t part) const { return parts_[part].points; }

 private:
  /// A verified first pass and a round with its warm-up and new process take about this many passes over the points.
  static constexpr double verify_factor = 2, round_factor = 1.3;
  double work_s(std::size_t part) const { return rate_ * parts_[part].work + 0.3; }

  struct part_estimate {
    double work = 0;  ///< particles x pairs over those at H = 2 dx x steps / threads, over the points
    std::size_t points = 0;
    int rounds = 1;
    std::optional<double> verify_s, round_s;
  };
  std::vector<part_estimate> parts_;
  double peaks_s_ = 0, budget_s_ = 0;
  double rate_ = 0.4e-6;  ///< seconds per particle and step on one thread
};

}  // namespace pairsum::harness
