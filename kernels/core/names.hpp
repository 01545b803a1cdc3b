#pragma once
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/core/error.hpp>
#include <pairsum/core/nearest.hpp>

namespace pairsum {

/// The shortest text that reads back as the same number.
inline std::string number_text(double a) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, a).ptr};
}

/// Is the word one of a list with commas?
constexpr bool is_in(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    if (list.substr(0, comma) == word) return true;
    list.remove_prefix(comma == list.npos ? list.size() : comma + 1);
  }
  return false;
}

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

/// The error for a word that names nothing: the nearest of those that do and, unless that is enough, all of them.
template <class Names>
error unknown_name(std::string_view what, std::string_view word, const Names& valid) {
  constexpr std::size_t most_beside_a_hint = 12;
  const std::vector<std::string> words(std::ranges::begin(valid), std::ranges::end(valid));
  const std::string hint = hint_for(word, words);
  return error("unknown " + std::string(what) + " \"" + std::string(word) + "\";" + hint +
               (hint.empty() || words.size() <= most_beside_a_hint ? " valid: " + join(words) : ""));
}

/// Throws unknown_name unless `word` is one of `valid`.
template <class Names>
void check_word(std::string_view what, std::string_view word, const Names& valid) {
  if (std::ranges::find(valid, word) == std::ranges::end(valid)) throw unknown_name(what, word, valid);
}

}  // namespace pairsum
