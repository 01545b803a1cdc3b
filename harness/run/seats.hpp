#pragma once
#include <vector>

#include "harness/ranks/placement.hpp"

namespace pairsum::harness {

class thread_binding;

/// Where each of the processes that work together may run, by rank. All of them call it.
std::vector<rank_seat> seats_of(const thread_binding& binding);

}  // namespace pairsum::harness
