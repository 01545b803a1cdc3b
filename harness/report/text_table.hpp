#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pairsum::harness {

/// A text table: one header, columns as wide as their widest cell, two spaces between them.
class text_table {
 public:
  /// @param left how many columns, from the first, are aligned to the left; the others to the right
  text_table(std::vector<std::string> header, std::size_t left);
  /// Adds a row; missing cells are empty.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  /// The lines, each with a newline and without trailing spaces.
  std::string text() const;
  /// The same as a table of Markdown.
  std::string markdown() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
  std::size_t left_;
};

/// Breaks a text at spaces into lines of at most `width` characters; all but the first are
/// indented.
std::string wrapped(const std::string& text, std::size_t width = 120);

/// Seconds as milliseconds with about five digits and never an exponent; "-" without a value.
std::string ms(double seconds);

}  // namespace pairsum::harness
