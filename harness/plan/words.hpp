#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum::harness {

/// "1,2,4" -> {1,2,4}; "all" -> powers of two up to `cores`, and `cores`; "cores" -> `cores` alone; ranges "5..9" too.
/// Errors name the option and the word.
std::vector<int> parse_counts(const std::string& option, const std::string& text, int cores);

/// "0.02,0.03" -> {0.02, 0.03}; an error names the word that is no number.
std::vector<double> parse_numbers(const std::string& option, const std::string& text);

/// The same with all that is there, repeated or not: the numbers of a box.
std::vector<double> parse_row(const std::string& option, const std::string& text);

/// A whole number from 0 to 2^64 - 1.
std::uint64_t parse_seed(const std::string& option, const std::string& text);

/// "a,b,a" -> {"a","b"}: each once, in the order of their first; empty words are an error.
std::vector<std::string> parse_words(const std::string& option, const std::string& text);

/// The time in s of a state "evolved:0.5"; none for a state that is no such word. An error names what is wrong with it.
std::optional<double> evolved_time(std::string_view state);

}  // namespace pairsum::harness
