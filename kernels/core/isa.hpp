#pragma once
#include <string_view>
#include <vector>

namespace pairsum {

/// The words for "the best vector units of this machine", "none of them", and "what the backend is made for".
inline constexpr std::string_view best_isa = "best", scalar_isa = "scalar", default_isa = "default";

/// Instruction sets of vector units that this library was built for and this machine runs, best first: avx512, avx2,
/// sse4; neon.
std::vector<std::string_view> isa_names();

/// Throws pairsum::error unless `isa` is `scalar`, `best` or one of isa_names(); it says if the set is known but not
/// built, or not of this machine.
void check_isa(std::string_view isa);

}  // namespace pairsum
