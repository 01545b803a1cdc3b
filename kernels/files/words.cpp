#include <pairsum/files/words.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>

#include <pairsum/core/error.hpp>

namespace pairsum::files {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return parts;
}

bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::optional<double> number_in(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  if (first == text.npos) return {};
  text = text.substr(first, last + 1 - first);
  double number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

std::optional<boundary_rule> boundary_rule::of(const std::string& text) {
  if (text.empty()) return {};
  if (text == "none") return boundary_rule{};
  const std::size_t equals = text.find('=');
  boundary_rule rule{text.substr(0, equals), {}};
  if (equals != text.npos)
    for (const std::string_view value : split(std::string_view(text).substr(equals + 1), ','))
      rule.values.emplace_back(value);
  if (rule.column.empty() || rule.values.empty())
    throw error("--boundary-kind is \"" + text + "\", should be a column with values, Type=0,1, or none");
  return rule;
}

bool boundary_rule::takes(std::string_view group) const {
  const std::string_view number = group.substr(group.find_last_not_of("0123456789") + 1);
  return std::ranges::any_of(values, [&](const std::string& v) { return same_word(v, group) || v == number; });
}

}  // namespace pairsum::files
