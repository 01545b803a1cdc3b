#include "harness/report/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pairsum::harness {

text_table::text_table(std::vector<std::string> header, std::size_t left) : header_(std::move(header)), left_(left) {}

void text_table::add(std::vector<std::string> cells) {
  cells.resize(header_.size());
  rows_.push_back(std::move(cells));
}

std::string text_table::text() const {
  std::vector<std::size_t> widths;
  for (const std::string& title : header_) widths.push_back(title.size());
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string out;
  const auto put = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += "  ";
      line += i < left_ ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("{:>{}}", row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  };
  put(header_);
  for (const auto& row : rows_) put(row);
  return out;
}

std::string text_table::markdown() const {
  std::string out;
  const auto put = [&](const std::vector<std::string>& row) {
    for (const std::string& cell : row) {
      out += "| ";
      for (const char c : cell) out += c == '|' ? std::string("\\|") : std::string(1, c);
      out += " ";
    }
    out += "|\n";
  };
  put(header_);
  for (std::size_t i = 0; i < header_.size(); ++i) out += i < left_ ? "|---" : "|---:";
  out += "|\n";
  for (const auto& row : rows_) put(row);
  return out;
}

std::string wrapped(const std::string& text, std::size_t width) {
  const std::string indent = "    ";
  std::string out, line, word;
  const auto flush_word = [&] {
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ' || c == '\n')
      flush_word();
    else
      word += c;
  }
  flush_word();
  return out + line + "\n";
}

std::string ms(double seconds) {
  const double value = seconds * 1e3;
  if (!std::isfinite(value)) return "-";
  const int digits = value < 10 ? 4 : value < 100 ? 3 : value < 1000 ? 2 : value < 10000 ? 1 : 0;
  return fmt::format("{:.{}f}", value, digits);
}

}  // namespace pairsum::harness
