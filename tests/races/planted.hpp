#pragma once
#include <vector>

#include <pairsum/sum/schedule.hpp>

namespace pairsum::races {

/// Backends with a race on purpose, which must be reported.
std::vector<backend_entry> planted_backends();

}  // namespace pairsum::races
