#include "harness/plan/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

template <class N>
N number(const std::string& option, const std::string& word, const char* kind) {
  N value{};
  const char* const end = word.data() + word.size();
  const auto [stop, failed] = std::from_chars(word.data(), end, value);
  const bool padded = word.size() > 1 && word[0] == '0' && word[1] >= '0' && word[1] <= '9';  // of "0,012"
  if (failed != std::errc{} || stop != end || padded)
    throw error(fmt::format("{} takes {}, not \"{}\"", option, kind, word));
  return value;
}

void add_once(std::vector<int>& values, int v) {
  if (std::ranges::find(values, v) == values.end()) values.push_back(v);
}

}  // namespace

std::vector<std::string> parse_words(const std::string& option, const std::string& text) {
  constexpr std::size_t most_words = 1000, longest = 200;
  if (const auto commas = static_cast<std::size_t>(std::ranges::count(text, ',')); commas >= most_words)
    throw error(fmt::format("{} has {} words, at most {} are taken", option, commas + 1, most_words));
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = text.find(',', begin);
    const std::string word = text.substr(begin, comma == text.npos ? text.npos : comma - begin);
    if (word.empty()) throw error(fmt::format("{} has an empty word in \"{}\"", option, text));
    if (word.size() > longest)
      throw error(fmt::format("{} has a word of {} characters, at most {} are taken", option, word.size(), longest));
    if (std::ranges::find(words, word) == words.end()) words.push_back(word);
    if (comma == text.npos) return words;
    begin = comma + 1;
  }
}

std::vector<int> parse_counts(const std::string& option, const std::string& text, int cores) {
  constexpr const char* kind = "whole numbers like 1,2 or 5..9";
  std::vector<int> values;
  for (const std::string& word : parse_words(option, text)) {
    const std::size_t dots = word.find("..");
    if (word == "cores" && cores > 0) {
      add_once(values, cores);
    } else if (word == "all" && cores > 0) {
      for (int t = 1; t < cores; t *= 2) add_once(values, t);
      add_once(values, cores);
    } else if (dots != word.npos) {
      const int first = number<int>(option, word.substr(0, dots), kind),
                last = number<int>(option, word.substr(dots + 2), kind);
      if (last < first || last - first > 10000)
        throw error(fmt::format("{}: \"{}\" is no ascending range", option, word));
      for (int v = first; v <= last; ++v) add_once(values, v);
    } else {
      add_once(values, number<int>(option, word, kind));
    }
  }
  return values;
}

std::uint64_t parse_seed(const std::string& option, const std::string& text) {
  return number<std::uint64_t>(option, text, "a whole number from 0");
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text) {
  std::vector<double> values;
  for (const std::string& word : parse_words(option, text))
    values.push_back(number<double>(option, word, "numbers like 0.02,0.03 (decimals after a point)"));
  return values;
}

std::vector<double> parse_row(const std::string& option, const std::string& text) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    values.push_back(number<double>(option, text.substr(begin, comma - begin), "numbers like 1,1,0.5"));
    begin = comma + 1;
  }
  return values;
}

std::optional<double> evolved_time(std::string_view state) {
  constexpr std::string_view word = "evolved:";
  if (!state.starts_with(word)) return std::nullopt;
  const std::string_view text = state.substr(word.size());
  double time = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (code != std::errc() || end != text.data() + text.size() || !(time > 0) || !std::isfinite(time))
    throw error(fmt::format("a state is evolved to a positive time in s, like evolved:0.5, not \"{}\"", state));
  return time;
}

}  // namespace pairsum::harness
