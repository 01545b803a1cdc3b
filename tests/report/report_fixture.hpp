#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/report/report.hpp"
#include "harness/report/summary.hpp"
#include "tests/report/synthetic.hpp"
#include "tests/rows/scratch.hpp"

namespace pairsum::harness {
using nlohmann::json;
using synthetic::made_point;

/// Reports of made-up rows.
class report : public scratch {
 protected:
  std::filesystem::path rows_path() const { return file("talk/rows.jsonl"); }

  /// The talk's comparisons with known times.
  static std::vector<made_point> talk() {
    return {{"naive", 6, 1, 1.0},         {"naive", 7, 1, 0.8},         {"symmetric", 6, 1, 0.5},
            {"naive_omp", 6, 2, 0.6},     {"symmetric_omp", 6, 1, 0.5}, {"symmetric_omp", 6, 2, 0.3},
            {"symmetric_tbb", 6, 1, 0.5}, {"symmetric_tbb", 6, 2, 0.2}, {"symmetric_tbb", 6, 4, 0.2, 5}};
  }

  /// A rows file of a study.
  void write(const std::vector<made_point>& points, int rounds = 6) const {
    row_writer writer(rows_path());
    writer.write(example::environment());
    synthetic::write_rounds(writer, points, rounds);
  }

  json make(bool allow_mixed = false) {
    text_ = make_report({file("talk")}, {file("out"), allow_mixed});
    return json::parse(get(file("out/summary.json")));
  }

  /// The summary of a study.
  json summary_of(const std::vector<made_point>& points, int rounds = 6) {
    write(points, rounds);
    return make();
  }

  /// The one entry (or entry of a point) that has these values; null if there is none.
  static json only(const json& entries, const json& wanted) {
    json found;
    for (const json& entry : entries) {
      const json& keys = entry.contains("point") ? entry["point"] : entry;
      bool same = true;
      for (const auto& item : wanted.items()) same = same && keys.at(item.key()) == item.value();
      if (!same) continue;
      EXPECT_TRUE(found.is_null()) << "two entries for " << wanted;
      found = entry;
    }
    return found;
  }

  static bool has_caveat(const json& summary, const std::string& part) {
    for (const json& caveat : summary["caveats"])
      if (caveat.get<std::string>().find(part) != std::string::npos) return true;
    return false;
  }

  std::string text_;
};

#define EXPECT_VALUE(entry, expected) EXPECT_NEAR((entry).get<double>(), expected, 1e-9 * (expected))

}  // namespace pairsum::harness
