#pragma once
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace pairsum {

/// Stand-in: one instruction set.
inline std::vector<std::string_view> isa_names() { return {"sse4"}; }

/// Throws pairsum::error unless the word is best or one of isa_names().
inline void check_isa(std::string_view word) {
  if (word != "best") check_word("isa", word, isa_names());
}

}  // namespace pairsum
