#pragma once
#include <string>

namespace pairsum {

/// Throws pairsum::error if `what` would take more bytes than the machine has memory; `advice` says what would take
/// less.
void check_memory(double bytes, const std::string& what, const std::string& advice);

}  // namespace pairsum
