#pragma once
#include <pairsum/sum/backend_traits.hpp>
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// A backend's row; study, utc and environment are the caller's.
backend_row describe_backend(const backend_traits& b);

}  // namespace pairsum::harness
