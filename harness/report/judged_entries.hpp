#pragma once

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "harness/stats/holm.hpp"
#include "harness/stats/ratio.hpp"

namespace pairsum::harness {

/// The interval of a ratio as "low", "high" and "confidence", null where there is none.
inline void put_bounds(nlohmann::json& entry, const std::optional<interval>& bounds) {
  entry["low"] = bounds ? nlohmann::json(bounds->low) : nlohmann::json(nullptr);
  entry["high"] = bounds ? nlohmann::json(bounds->high) : nlohmann::json(nullptr);
  entry["confidence"] = bounds ? nlohmann::json(bounds->confidence) : nlohmann::json(nullptr);
}

/// Entries of a table with their ratios, which are judged together (Holm, 95 %).
class judged_entries {
 public:
  /// Writes the ratio as `key`, its interval, and the rounds that it is paired by (0: not paired).
  void add(nlohmann::json entry, const char* key, const ratio_estimate& ratio) {
    entry[key] = ratio.value;
    put_bounds(entry, ratio.bounds);
    entry["rounds"] = ratio.pairs;
    add(std::move(entry), ratio);
  }
  /// Judges the entry by the ratio and writes nothing of it.
  void add(nlohmann::json entry, const ratio_estimate& ratio) {
    entries_.push_back(std::move(entry));
    ratios_.push_back(ratio);
  }
  /// All entries, each with its "verdict".
  nlohmann::json judged() && {
    const std::vector<ratio_verdict> verdicts = verdicts_of(ratios_);
    for (std::size_t k = 0; k < verdicts.size(); ++k) entries_[k]["verdict"] = word_of(verdicts[k]);
    return std::move(entries_);
  }

 private:
  nlohmann::json entries_ = nlohmann::json::array();
  std::vector<ratio_estimate> ratios_;
};

}  // namespace pairsum::harness
