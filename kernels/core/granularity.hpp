#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include <pairsum/core/team.hpp>

namespace pairsum {

/// OpenMP: `dynamic:32` (and static, guided; `static:0` is one contiguous piece per thread). oneTBB: `auto:32` (and
/// simple, static), the number being the grain. Backends without threads of their own: `none`.
std::string name_of(const granularity& g);

/// From such a word, for a backend that runs on `r`. Throws pairsum::error that says which words there are.
granularity parse_granularity(std::string_view word, runtime r);

}  // namespace pairsum
