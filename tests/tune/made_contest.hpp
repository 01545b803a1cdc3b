#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pairsum/core/random.hpp>
#include "harness/tune/contest.hpp"

namespace pairsum::harness {

/// A contest whose truth is known, on a clock of its own.
struct made_contest {
  std::vector<double> truth_s;  ///< of each candidate
  double budget_s = 60;
  double noise = 0.02;       ///< of each measurement, standard deviation of its logarithm
  double drift = 0;          ///< of the machine over a round, common to all
  double twice_as_long = 0;  ///< how often something else takes half of the machine
  double overhead_s = 0.1;   ///< of a measurement beside twice its time
  std::vector<std::size_t> wrong = {};
  int interrupted_after = 1 << 30;  ///< measurements
  std::vector<std::string> families = {};
  contest_rules rules = {};
  std::uint64_t seed = 1;

  double clock_s = 0;
  std::vector<std::size_t> measured = {};
  std::vector<contestant> all = {};

  void run() {
    all.resize(truth_s.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k].family = families.empty() ? std::to_string(k) : families[k];
    const counter_random random(seed);
    contest_world world;
    world.left_s = [&] { return budget_s - clock_s; };
    world.interrupted = [&] { return static_cast<int>(measured.size()) >= interrupted_after; };
    world.measure = [&](std::size_t k, std::string& error) -> std::optional<double> {
      const std::uint64_t at = 12 * measured.size();
      double normal = -6;  // of 12 uniform numbers
      for (std::uint64_t i = 0; i < 12; ++i) normal += random.uniform(at + i);
      measured.push_back(k);
      const bool disturbed = random.uniform((std::uint64_t{1} << 40) + at) < twice_as_long;
      const double seconds =
          (disturbed ? 2 : 1) * truth_s[k] * std::exp(noise * normal + drift * std::sin(0.3 * clock_s));
      clock_s += 2 * seconds + overhead_s;
      if (std::ranges::find(wrong, k) == wrong.end()) return seconds;
      error = "made to be wrong";
      return std::nullopt;
    };
    contend(all, rules, world);
  }

  std::size_t looks() const {
    return static_cast<std::size_t>(std::ranges::count_if(all, [](const auto& c) { return c.look_s.has_value(); }));
  }
};

}  // namespace pairsum::harness
