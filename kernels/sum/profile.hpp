#pragma once
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// Choices that were found to be fast (by `pairsum tune`), as words like
/// "backend=symmetric_omp grid=hashed_grid M=7 precision=double threads=2 granularity=dynamic:32".
struct profile {
  setup words;      ///< backend, grid, M, isa, block and precision; the rest is left at its defaults
  int threads = 1;  ///< for the team that sums
  std::string granularity = "default";  ///< for parse_granularity, unless it is "default"

  /// The same words in another setup, whose domain, formula and cache stay as they are.
  setup in(setup s) const {
    s.backend = words.backend;
    s.grid = words.grid;
    s.M = words.M;
    s.isa = words.isa;
    s.block = words.block;
    s.precision = words.precision;
    return s;
  }
};

namespace detail {

inline int whole_number(std::string_view key, std::string_view text) {
  int value = 0;
  const auto [stop, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc{} || stop != text.data() + text.size() || value < 1)
    throw error("a profile's " + std::string(key) + " should be a whole number from 1, is \"" + std::string(text) +
                "\"");
  return value;
}

}  // namespace detail

/// The profile of such words, parted by blanks; "backend" and "threads" must be there, the others may be. Throws
/// pairsum::error for a key that is unknown, there twice or missing, and for numbers that are none; whether there is
/// such a backend, make_summation says.
inline profile parse_profile(std::string_view text) {
  profile p;
  const std::vector<std::string_view> keys{"backend", "grid",      "M",       "isa",
                                           "block",   "precision", "threads", "granularity"};
  std::vector<std::string_view> seen;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    check_word("key of a profile", key, keys);
    if (equals == word.npos || equals + 1 == word.size())
      throw error("a profile's " + std::string(key) + " has no value");
    if (std::ranges::find(seen, key) != seen.end()) throw error("a profile has " + std::string(key) + " twice");
    seen.push_back(key);
    const std::string value(word.substr(equals + 1));
    if (key == "backend") p.words.backend = value;
    if (key == "grid") p.words.grid = value;
    if (key == "M") p.words.M = detail::whole_number(key, value);
    if (key == "isa") p.words.isa = value;
    if (key == "block") p.words.block = value;
    if (key == "precision") p.words.precision = value;
    if (key == "threads") p.threads = detail::whole_number(key, value);
    if (key == "granularity") p.granularity = value;
  }
  for (const std::string_view key : {"backend", "threads"})
    if (std::ranges::find(seen, key) == seen.end()) throw error("a profile lacks " + std::string(key));
  return p;
}

}  // namespace pairsum
