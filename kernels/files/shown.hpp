#pragma once
#include <string>
#include <string_view>

namespace pairsum::files {

/// Words of a file as messages and tables show them: quoted, cut where they are long, with a `?` for what is no
/// character of text.
inline std::string shown(std::string_view words) {
  constexpr std::size_t longest = 60;
  std::string text = "\"";
  for (const char c : words.substr(0, longest)) text += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  return text + (words.size() > longest ? "...\"" : "\"");
}

}  // namespace pairsum::files
