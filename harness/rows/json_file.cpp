#include "harness/rows/json_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

using nlohmann::json;

constexpr int deepest = 32;
constexpr std::size_t most_bytes = std::size_t{16} << 20;

std::string twice(const json& key) { return "key " + key.dump() + " is there twice in its object"; }

/// Of all its objects.
std::size_t keys_in(const json& value) {
  std::size_t n = value.is_object() ? value.size() : 0;
  for (const json& part : value)
    if (part.is_structured()) n += keys_in(part);
  return n;
}

/// Colons outside of strings, one behind each key, of a text that is JSON.
std::size_t colons_in(std::string_view text) {
  std::size_t n = 0;
  bool inside = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    inside ^= c == '"';
    n += c == ':' && !inside ? 1 : 0;
    at += c == '\\' ? 1 : 0;  // only strings have some
  }
  return n;
}

/// Goes through a text and says how far any copy of it has come.
class reported {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  reported(const char* at, const char*& reached) : at_(at), reached_(&reached) {}
  reference operator*() const { return *at_; }
  reported& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  bool operator==(const reported& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

/// One text on its way to a value.
class reading {
 public:
  reading(std::string_view text, const std::string& name) : text_(text), name_(name), reached_(text.data()) {}

  json value() {
    const auto look = [this](int depth, json::parse_event_t event, json& part) {
      check(depth, event, part);
      return true;
    };
    try {
      return json::parse(reported(text_.data(), reached_), reported(text_.data() + text_.size(), reached_), look);
    } catch (const json::parse_error& e) {
      fail("this is no JSON: " + reason(e.what()));
    } catch (const json::out_of_range&) {
      fail("a number is out of range");
    }
  }

 private:
  void check(int depth, json::parse_event_t event, const json& part) {
    using is = json::parse_event_t;
    if ((event == is::object_start || event == is::array_start) && depth >= deepest)
      fail("more than " + std::to_string(deepest) + " levels of lists and objects");
    if (event == is::object_start) keys_.emplace_back();
    if (event == is::object_end) keys_.pop_back();
    if (event != is::key || keys_.back().insert(part.get<std::string>()).second) return;
    do --reached_;
    while (!begins_key());
    fail(twice(part));
  }

  /// Is the last byte before `reached_` the quotation mark with which the key begins?
  bool begins_key() const {
    const char* before = reached_ - 1;
    if (*before != '"') return false;
    std::size_t backslashes = 0;
    while (before > text_.data() && *--before == '\\') ++backslashes;
    return backslashes % 2 == 0;
  }

  /// What the library says behind its own name, number and position.
  static std::string reason(const std::string& said) {
    const std::size_t position = said.find(" column "), colon = said.find(": ", position);
    return colon == said.npos ? said : said.substr(colon + 2);
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string_view before = text_.substr(0, static_cast<std::size_t>(reached_ - text_.data() - 1));
    const auto lines = std::ranges::count(before, '\n');
    const auto columns = std::ranges::count_if(before.substr(before.rfind('\n') + 1),  // npos + 1 is 0
                                               [](char c) { return (c & 0xC0) != 0x80; });
    throw error(name_ + ":" + std::to_string(lines + 1) + ":" + std::to_string(columns + 1) + ": " + what);
  }

  std::string_view text_;
  const std::string& name_;
  const char* reached_;  ///< behind what was read last, at which the fault is
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

void check_encoding(std::string_view beginning, const std::string& name) {
  if (beginning.starts_with("\xFF\xFE") || beginning.starts_with("\xFE\xFF") ||
      (beginning.size() > 1 && (beginning[0] == '\0') != (beginning[1] == '\0')))
    throw error(name + ": is UTF-16, should be UTF-8");
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

json parse_json(std::string_view text, const std::string& name) {
  check_encoding(text, name);
  if (text.find('\0') != text.npos) throw error(name + ": has NUL bytes, should be JSON, which is text");
  text = without_mark(text);
  if (text.find_first_not_of(" \t\r\n") == text.npos) throw error(name + ": is empty, should be JSON");
  return reading(text, name).value();
}

std::optional<std::string> doubled_key(std::string_view text, const json& value) {
  if (colons_in(text) == keys_in(value)) return std::nullopt;
  std::vector<std::set<json>> objects;
  std::optional<std::string> found;
  const auto look = [&](int, json::parse_event_t event, json& part) {
    if (event == json::parse_event_t::object_start) objects.emplace_back();
    if (event == json::parse_event_t::object_end) objects.pop_back();
    if (event == json::parse_event_t::key && !objects.back().insert(part).second && !found) found = twice(part);
    return true;
  };
  static_cast<void>(json::parse(text, look));
  return found;
}

json read_json_file(const std::filesystem::path& path, const std::string& kind) {
  const std::string name = path.string(), should = ", should be " + kind + " (a JSON file)";
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) throw error(name + ": is a folder" + should);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw error(name + ": cannot be read: " + std::strerror(errno) + should);
  std::string text;
  for (char part[65536]; file.read(part, sizeof part), file.gcount() > 0;) {
    text.append(part, static_cast<std::size_t>(file.gcount()));
    if (text.size() > most_bytes) throw error(name + ": has more than 16 MB" + should);
  }
  return parse_json(text, name);
}

}  // namespace pairsum::harness
