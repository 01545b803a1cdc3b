#pragma once
#include <string>

namespace pairsum {

/// Bytes of memory that this process may use: the machine's, or what control groups leave of it.
double usable_memory();

/// Throws pairsum::error if `what` would take more bytes than that; `advice` says what would take less.
void check_memory(double bytes, const std::string& what, const std::string& advice);

}  // namespace pairsum
