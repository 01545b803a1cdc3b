#include <algorithm>
#include <array>
#include <cstring>

#include <pairsum/core/error.hpp>
#include <pairsum/files/csv_lines.hpp>

namespace pairsum::files {
namespace {

constexpr std::streamoff megabyte = 1 << 20;

}  // namespace

csv_lines::csv_lines(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw error(path + " cannot be read");
  std::array<char, 2> mark{};
  file_.read(mark.data(), mark.size());
  if (const std::string_view m(mark.data(), mark.size()); m == "\xff\xfe" || m == "\xfe\xff")
    throw error(path + " is text in UTF-16, should be in UTF-8; save it so, or `iconv -f UTF-16 -t UTF-8` makes it so");
  file_.clear();
  file_.seekg(0, std::ios::end);
  // Small files need no more than their size, and a byte that says that they end there.
  piece_ = static_cast<std::size_t>(std::clamp<std::streamoff>(file_.tellg(), 0, megabyte - 1)) + 1;
  buffer_.resize(2 * piece_);
  file_.seekg(0);
  fill();
  if (std::string_view(buffer_.data(), end_).starts_with("\xef\xbb\xbf")) begin_ = 3;
}

void csv_lines::refuse(const std::string& what) const {
  throw error(path_ + ": line " + std::to_string(number_) + ": " + what);
}

/// Moves what is left to the buffer's begin and reads a megabyte behind it; false: nothing came.
bool csv_lines::fill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  file_.read(buffer_.data() + end_, static_cast<std::streamsize>(piece_));
  const auto came = static_cast<std::size_t>(file_.gcount());
  if (file_.bad()) throw error(path_ + " cannot be read to its end");
  if (std::memchr(buffer_.data() + end_, '\0', came)) throw error(path_ + " is no text: it has a byte 0");
  end_ += came;
  return came > 0;
}

bool csv_lines::next(std::string_view& line) {
  std::size_t searched = 0;
  const char* end = nullptr;
  for (;;) {
    const char* from = buffer_.data() + begin_;
    end = static_cast<const char*>(std::memchr(from + searched, '\n', end_ - begin_ - searched));
    if (end) break;
    searched = end_ - begin_;
    if (searched > piece_) {
      ++number_;
      refuse("is longer than a megabyte; it should have the numbers of one particle");
    }
    if (!fill()) break;
  }
  if (!end && begin_ == end_) return false;
  const char* from = buffer_.data() + begin_;
  line = {from, static_cast<std::size_t>((end ? end : buffer_.data() + end_) - from)};
  begin_ += line.size() + (end ? 1 : 0);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++number_;
  return true;
}

std::uint64_t csv_lines::count_left() {
  const char* text = buffer_.data();
  auto lines = static_cast<std::uint64_t>(std::count(text + begin_, text + end_, '\n')) + 1;
  file_.clear();
  const auto here = file_.tellg();
  std::vector<char> piece(piece_);
  while (file_.read(piece.data(), static_cast<std::streamsize>(piece_)), file_.gcount() > 0)
    lines += static_cast<std::uint64_t>(std::count(piece.begin(), piece.begin() + file_.gcount(), '\n'));
  file_.clear();
  file_.seekg(here);
  return lines;
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    std::size_t end = 0;
    if (!line.starts_with('"')) {
      end = std::min(line.find(separator), line.size());
      fields.push_back(trimmed(line.substr(0, end)));
    } else {
      std::size_t close = line.find('"', 1);
      while (close != line.npos && line.substr(close + 1).starts_with('"')) close = line.find('"', close + 2);
      if (close == line.npos) return false;
      end = std::min(line.find(separator, close), line.size());
      if (!trimmed(line.substr(close + 1, end - close - 1)).empty()) return false;
      fields.push_back(trimmed(line.substr(1, close - 1)));
    }
    if (end == line.size()) return true;
    line.remove_prefix(end + 1);
  }
}

}  // namespace pairsum::files
