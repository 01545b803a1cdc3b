#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum {

/// How many letters must be inserted, deleted, replaced, or swapped with the next one to make one word of the other:
/// the optimal string alignment distance (Damerau 1964, Wagner and Fischer 1974). Upper and lower case are the same.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The words that somebody who wrote `word` may have meant, at most three: those nearest by edit distance, which is at
/// most a third of the word's length, or those that begin with it.
std::vector<std::string> nearest_words(std::string_view word, const std::vector<std::string>& valid);

/// " did you mean a or b?", with the blank; empty if no word is near.
std::string hint_for(std::string_view word, const std::vector<std::string>& valid);

}  // namespace pairsum
