#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/report/text_table.hpp"

/// The tables of a summary; empty where nothing of the kind was measured.
namespace pairsum::harness {

/// A table with the line that says what it shows.
struct report_table {
  std::string caption;
  text_table table;
};

// Of one series.
report_table summation_table(const nlohmann::json& summary, std::size_t series);
report_table algorithm_table(const nlohmann::json& summary, std::size_t series);
report_table scaling_table(const nlohmann::json& summary, std::size_t series);
report_table runtime_table(const nlohmann::json& summary, std::size_t series);
report_table m_table(const nlohmann::json& summary, std::size_t series);
report_table bound_table(const nlohmann::json& summary, std::size_t series);
report_table phase_table(const nlohmann::json& summary, std::size_t series);
report_table build_table(const nlohmann::json& summary, std::size_t series);

// Of all series.
report_table self_test_table(const nlohmann::json& summary);

/// The summation times of a series as text: a column per number of threads, with intervals, speedups and time per pair.
std::string summation_text(const nlohmann::json& summary, std::size_t series);

}  // namespace pairsum::harness
