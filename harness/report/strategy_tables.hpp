#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/report/report_tables.hpp"

namespace pairsum::harness {

/// The ladder of a series, one line per backend at its most threads.
report_table strategy_table(const nlohmann::json& summary, std::size_t series);

/// What each backend says of itself, and how it avoids conflicts.
report_table strategies_table(const nlohmann::json& summary);

/// Where they break down, a line or more each; empty if none does.
std::string breakdown_list(const nlohmann::json& summary);

/// How the backends' standing changes from one world to another.
report_table shifts_table(const nlohmann::json& summary);

}  // namespace pairsum::harness
