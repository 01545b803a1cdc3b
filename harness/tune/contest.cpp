#include "harness/tune/contest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/plan/plan.hpp"
#include "harness/stats/ratio.hpp"
#include "harness/tune/paired_times.hpp"

namespace pairsum::harness {
namespace {

constexpr double pass_by_factor = 2;  ///< of the fastest look, beyond which the rest of a family gets none
constexpr double relook_factor = 3;   ///< beyond which a candidate gets no further look

class search {
 public:
  search(std::vector<contestant>& all, const contest_rules& rules, const contest_world& world)
      : all_(all), rules_(rules), world_(world), all_s_(world.left_s()) {}

  void run() {
    look();
    leave_slow_ones();
    for (int round = 1; round <= rules_.most_rounds && !over(round); ++round) {
      halve(round);
      if (!measure_round(round)) return;
      drop_worse_ones();
    }
  }

 private:
  std::vector<std::size_t> standing() const {
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < all_.size(); ++k)
      if (all_[k].what == fate::standing) left.push_back(k);
    return left;
  }

  double fastest_look() const {
    double best = std::numeric_limits<double>::infinity();
    for (const contestant& c : all_)
      if (c.look_s) best = std::min(best, *c.look_s);
    return best;
  }

  std::optional<double> measure(std::size_t k) {
    const double before = world_.left_s();
    const auto seconds = world_.measure(k, all_[k].error);
    all_[k].cost_s = std::max(1e-9, before - world_.left_s());
    if (!seconds) all_[k].what = fate::wrong;
    return seconds;
  }

  double best_look_of(const std::string& family) const {
    double best = std::numeric_limits<double>::infinity();
    for (const contestant& c : all_)
      if (c.family == family && c.look_s) best = std::min(best, *c.look_s);
    return best;
  }

  /// Has another of its family shown that it is not worth a look?
  bool hopeless(const contestant& c) const {
    const double best = best_look_of(c.family);
    return std::isfinite(best) && best > pass_by_factor * fastest_look();
  }

  void look() {
    for (int pass = 1; pass <= rules_.looks; ++pass) {
      const double reserve = (pass == 1 ? 1 - rules_.share_of_looks : 0.5) * all_s_;
      for (std::size_t k = 0; k < all_.size(); ++k) {
        if (world_.interrupted() || world_.left_s() <= reserve) return;
        look_at(k, pass);
      }
    }
  }

  /// Not if it was far slower than the fastest; but for its family the best gets one, lest the first was unlucky.
  bool deserves_another_look(const contestant& c) const {
    return *c.look_s <= relook_factor * fastest_look() || *c.look_s <= best_look_of(c.family);
  }

  void look_at(std::size_t k, int pass) {
    contestant& c = all_[k];
    if (c.what == fate::wrong || (c.look_s && !deserves_another_look(c))) return;
    if (!c.look_s && hopeless(c)) {
      c.what = fate::passed_by;
      return;
    }
    world_.show(fmt::format("look {} at {}/{}", pass, k + 1, all_.size()));
    if (const auto seconds = measure(k)) {
      c.look_s = std::min(c.look_s.value_or(*seconds), *seconds);
      c.what = fate::standing;
    }
  }

  void leave_slow_ones() {
    const double most = rules_.far_too_slow * fastest_look();
    auto left = standing();
    std::ranges::stable_sort(left, {}, [&](std::size_t k) { return *all_[k].look_s; });
    for (std::size_t at = rules_.fewest; at < left.size(); ++at)
      if (*all_[left[at]].look_s > most) all_[left[at]].what = fate::slow;
  }

  bool over(int round) const {
    const auto left = standing();
    return left.empty() || world_.interrupted() || (left.size() == 1 && round > rules_.least_rounds);
  }

  double cost_of_round() const {
    double cost = 0;
    for (const std::size_t k : standing()) cost += all_[k].cost_s;
    return cost;
  }

  double speed_of(std::size_t k) const { return all_[k].times.empty() ? *all_[k].look_s : typical_time(all_[k]); }

  /// Before every least_rounds further rounds, so that more time is left for the faster half; and when the time left
  /// does not pay for the least rounds of all.
  void halve(int round) {
    if (round > 1 && (round - 1) % rules_.least_rounds == 0) keep_faster_half(rules_.fewest);
    const int wanted = rules_.least_rounds - round + 1;
    while (standing().size() > 2 && wanted * cost_of_round() > world_.left_s()) keep_faster_half(2);  // two: a ratio
  }

  void keep_faster_half(std::size_t at_least) {
    auto left = standing();
    std::ranges::stable_sort(left, {}, [&](std::size_t k) { return speed_of(k); });
    for (std::size_t k = std::max(at_least, (left.size() + 1) / 2); k < left.size(); ++k)
      all_[left[k]].what = fate::halved;
  }

  /// False if the time does not pay for the round, or ended in it; a part of a round counts for nothing.
  bool measure_round(int round) {
    const auto left = standing();
    if (left.empty() || cost_of_round() > world_.left_s()) return false;
    world_.show(fmt::format("round {}, {} candidate{}", round, left.size(), left.size() == 1 ? "" : "s"));
    std::map<std::size_t, double> times;
    for (const std::size_t at : shuffled_order(left.size(), rules_.seed, round, 1)) {
      if (world_.interrupted()) return false;
      if (const auto seconds = measure(left[at])) times[left[at]] = *seconds;
    }
    for (const auto& [k, seconds] : times) all_[k].times[round] = seconds;
    return true;
  }

  void drop_worse_ones() {
    const auto best = winner_of(all_);
    if (!best) return;
    for (const std::size_t k : standing()) {
      if (k == *best) continue;
      const ratio_estimate r = ratio_to(all_[k], all_[*best], rules_.drop_level);
      if (r.bounds && r.bounds->low > 1) all_[k].what = fate::worse;
    }
  }

  std::vector<contestant>& all_;
  const contest_rules& rules_;
  const contest_world& world_;
  double all_s_;
};

}  // namespace

void contend(std::vector<contestant>& all, const contest_rules& rules, const contest_world& world) {
  search(all, rules, world).run();
}

std::optional<std::size_t> winner_of(const std::vector<contestant>& all) {
  std::optional<std::size_t> best;
  const auto time = [&](std::size_t k) { return all[k].times.empty() ? *all[k].look_s : typical_time(all[k]); };
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].what == fate::standing && (!best || time(k) < time(*best))) best = k;
  return best;
}

}  // namespace pairsum::harness
