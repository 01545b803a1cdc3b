#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum::files {

/// The parts between separators; none of an empty text.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The same letters, in upper or lower case?
bool same_word(std::string_view a, std::string_view b);

/// The number that all of the text is, blanks around it aside.
std::optional<double> number_in(std::string_view text);

/// What makes particles boundary, in the words of an option: "Type=0,1", a column and its values; "PartType=1,3" or
/// "name=wall", groups by number or name; "none".
struct boundary_rule {
  std::string column;
  std::vector<std::string> values;

  /// None for an empty text. Errors: a text of no such form.
  static std::optional<boundary_rule> of(const std::string& text);
  bool none() const { return column.empty(); }
  /// Is it about groups of a file, not about a column?
  /// Is a group's name, or the number at its end, one of the values?
  bool takes(std::string_view group) const;
  bool names_groups() const { return same_word(column, "name") || same_word(column, "PartType"); }
};

}  // namespace pairsum::files
