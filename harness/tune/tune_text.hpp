#pragma once
#include <string>

#include "harness/tune/tune.hpp"

namespace pairsum::harness {

/// What tune() found, in lines: the winner with its interval, the ladder of those that it beat or could not be told
/// from, and what was not measured or wrong.
std::string tune_text(const tune_request& r, const tune_result& result, const registry& all, bool colours = false);

}  // namespace pairsum::harness
