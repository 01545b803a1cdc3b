#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/sum/registry.hpp>

namespace pairsum::harness {

/// The precisions for which a backend has a formula in this build.
std::vector<std::string> precisions_of(const backend_entry& b, const registry& r);

/// By backend the section of docs/strategies.md on it, like "#gather".
const std::map<std::string_view, std::string_view>& strategy_sections();

/// What there is, on a screen of 24 lines and 80 columns: families of backends, the words of everything else.
std::string overview_text(const registry& r);

/// What there is of one kind (backends, plans, cases, ...), a line each. Throws pairsum::error that lists the kinds.
std::string kind_text(const std::string& kind, const registry& r);

/// What a backend says of itself. Throws pairsum::error for a name that is unknown.
std::string backend_text(const std::string& name, const registry& r);

}  // namespace pairsum::harness
