#pragma once
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace pairsum {

/// "a, b, c"
template <class Names>
std::string join(const Names& names) {
  std::string all;
  for (const auto& n : names) {
    if (!all.empty()) all += ", ";
    all += n;
  }
  return all;
}

/// The error for a word that names nothing: lists the words that do.
template <class Names>
error unknown_name(std::string_view what, std::string_view word, const Names& valid) {
  return error("unknown " + std::string(what) + " \"" + std::string(word) + "\"; valid: " + join(valid));
}

}  // namespace pairsum
