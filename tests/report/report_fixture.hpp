#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "harness/report/report.hpp"
#include "harness/report/summary.hpp"
#include "tests/report/synthetic.hpp"
#include "tests/rows/scratch.hpp"

namespace pairsum::harness {
using nlohmann::json;
using synthetic::write_point;

/// Reports of made-up rows.
class report : public scratch {
 protected:
  std::filesystem::path rows_path() const { return file("talk/rows.jsonl"); }

  /// The talk's comparisons with known times.
  void write_all() const {
    row_writer writer(rows_path());
    writer.write(example::environment());
    write_point(writer, "naive", 6, 1, 1.0);
    write_point(writer, "naive", 7, 1, 0.8);
    write_point(writer, "symmetric", 6, 1, 0.5);
    write_point(writer, "naive_omp", 6, 2, 0.6);
    write_point(writer, "symmetric_omp", 6, 1, 0.5);
    write_point(writer, "symmetric_omp", 6, 2, 0.3);
    write_point(writer, "symmetric_tbb", 6, 1, 0.5);
    write_point(writer, "symmetric_tbb", 6, 2, 0.2);
    write_point(writer, "symmetric_tbb", 6, 4, 0.2, 5);
  }

  json make(bool allow_mixed = false) {
    report_options options;
    options.summary_path = file("out/summary.json");
    options.allow_mixed = allow_mixed;
    text_ = make_report({file("talk")}, options);
    return json::parse(get(options.summary_path));
  }

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

}  // namespace pairsum::harness
