#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/report/ladders.hpp"

/// How backends keep threads apart, and what that costs: the arrays of summary.json (docs/design.md, section 4). Times
/// are those of whole evaluations (prepare, zero, sum, reduce).
namespace pairsum::harness {

/// Each rung against the base of its ladder; with the cost of its strategy on one thread, its efficiency, its threads'
/// waiting, and its memory.
nlohmann::json strategy_ladder(const measurements& all, const std::vector<ladder>& ladders);

/// Each backend over threads, as it was at its best on the most, against the ladders' base on one thread.
nlohmann::json strategy_threads(const measurements& all, const std::vector<ladder>& ladders);

/// How each backend stands to the base in one series, over how it stands in another that differs in one respect:
/// "dimension", "sparsity" (fewer neighbours in a domain that is wider in H) or "case". Standings are paired inside
/// rounds, so that a machine that changes between the two cancels.
nlohmann::json strategy_shifts(const measurements& all, const std::vector<ladder>& ladders);

/// Each backend of the ladders with what it says of itself and, in words, where it breaks down.
/// @param tables the summary with the three arrays above
nlohmann::json strategies(const nlohmann::json& tables);

/// Where a backend breaks down by these tables: texts, empty if nowhere. What counts is in docs/running.md.
std::vector<std::string> breakdowns(const nlohmann::json& tables, const std::string& backend);

}  // namespace pairsum::harness
