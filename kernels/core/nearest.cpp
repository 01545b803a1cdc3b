#include <pairsum/core/nearest.hpp>

#include <algorithm>
#include <cctype>

namespace pairsum {
namespace {

constexpr std::size_t most_hints = 3;

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between the first i letters of a and the first j of b.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last.back();
}

std::vector<std::string> nearest_words(std::string_view word, const std::vector<std::string>& valid) {
  std::vector<std::string> near;
  std::size_t least = 0;
  for (const std::string& v : valid) {
    const bool begins = word.size() > 1 && v.starts_with(word);
    const std::size_t distance = begins ? 1 : edit_distance(word, v);
    if (!begins && distance > word.size() / 3) continue;
    if (!near.empty() && distance > least) continue;
    if (!near.empty() && distance < least) near.clear();
    least = distance;
    near.push_back(v);
  }
  near.resize(std::min(near.size(), most_hints));
  return near;
}

std::string hint_for(std::string_view word, const std::vector<std::string>& valid) {
  std::string text;
  for (const std::string& v : nearest_words(word, valid))
    text.append(text.empty() ? " did you mean " : " or ").append(v);
  if (!text.empty()) text += '?';
  return text;
}

}  // namespace pairsum
