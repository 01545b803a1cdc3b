#pragma once
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum::files {

/// The lines of a text file, read by the megabyte. A byte order mark of UTF-8 is left out, so are ends of lines, LF or
/// CR LF. Errors, each one line that begins with the path: no text (UTF-16, a zero byte), a line longer than a
/// megabyte.
class csv_lines {
 public:
  explicit csv_lines(const std::string& path);

  /// The next line, which is valid until the next call; false at the end.
  bool next(std::string_view& line);
  std::uint64_t number() const { return number_; }          ///< of the line that next gave, from 1
  [[noreturn]] void refuse(const std::string& what) const;  ///< with the path and the line's number

  /// How many lines are left. Goes through the file once, and comes back.
  std::uint64_t count_left();

 private:
  bool fill();

  std::string path_;
  std::ifstream file_;
  std::size_t piece_ = 0;  ///< bytes read at once
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what is still to be given of the buffer
  std::uint64_t number_ = 0;
};

/// Cuts a line into its fields, without blanks around them and without quotes. Doubled quotes inside stay doubled.
/// False: a quote is not closed, or something follows one.
bool split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// The text without blanks and tabs around it.
std::string_view trimmed(std::string_view text);

}  // namespace pairsum::files
