#include "harness/rows/fields.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string_view>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

bool is_hex(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// YYYY-MM-DDThh:mm:ss, then optionally a point and digits, then Z.
bool is_utc(std::string_view text) {
  constexpr std::string_view pattern = "dddd-dd-ddTdd:dd:dd";
  if (text.size() <= pattern.size() || text.back() != 'Z') return false;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < pattern.size(); ++i)
    if (pattern[i] == 'd' ? !digit(text[i]) : text[i] != pattern[i]) return false;
  const std::string_view rest = text.substr(pattern.size(), text.size() - pattern.size() - 1);
  if (rest.empty()) return true;
  return rest.size() > 1 && rest[0] == '.' && std::all_of(rest.begin() + 1, rest.end(), digit);
}

/// Whether the value is an integer >= 0; comparing the JSON value itself would wrap large ones
/// around.
bool is_count(const nlohmann::json& value) {
  return value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
}

}  // namespace

bool has_controls(const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    if (byte < 0x20 || byte == 0x7F || (byte == 0xC2 && static_cast<unsigned char>(text[k + 1]) < 0xA0)) return true;
  }
  return false;
}

std::string describe(const nlohmann::json& value) {
  if (value.is_null()) return "null";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return "a boolean";
  if (value.is_array()) return "an array";
  if (value.is_object()) return "an object";
  return "the number " + value.dump();
}

fields::fields(const nlohmann::json& object, std::string prefix) : object_(object), prefix_(std::move(prefix)) {
  if (object_.is_object()) return;
  if (prefix_.empty()) throw error("a row should be an object, is " + describe(object_));
  throw error("key \"" + prefix_.substr(0, prefix_.size() - 1) + "\" should be an object, is " + describe(object_));
}

const nlohmann::json& fields::at(const char* key) {
  const auto found = object_.find(key);
  if (found == object_.end()) throw error("key \"" + prefix_ + key + "\" is missing");
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return *found;
}

void fields::reject(const char* key, const std::string& expected) const {
  throw error("key \"" + prefix_ + key + "\" should be " + expected + ", is " + describe(object_.at(key)));
}

void fields::finish() const {
  for (const auto& item : object_.items())
    if (std::find(asked_.begin(), asked_.end(), item.key()) == asked_.end())
      throw error("key \"" + prefix_ + item.key() + "\" is not known in this kind of row");
}

bool fields::is_null(const char* key) { return at(key).is_null(); }

fields fields::nested(const char* key) { return fields(at(key), prefix_ + key + "."); }

std::vector<fields> fields::objects(const char* key) {
  const nlohmann::json& list = at(key);
  if (!list.is_array()) reject(key, "a list of objects");
  std::vector<fields> all;
  for (std::size_t k = 0; k < list.size(); ++k)
    all.emplace_back(list[k], prefix_ + key + "[" + std::to_string(k) + "].");
  return all;
}

double fields::number(const char* key) {
  const auto& value = at(key);
  if (!value.is_number()) reject(key, "a number");
  return value.get<double>();
}

std::optional<double> fields::number_or_null(const char* key) {
  const auto& value = at(key);
  if (value.is_null()) return std::nullopt;
  if (!value.is_number()) reject(key, "a number or null");
  return value.get<double>();
}

std::optional<double> fields::amount_or_null(const char* key) {
  const auto value = number_or_null(key);
  if (value && *value < 0) reject(key, "a number >= 0 or null");
  return value;
}

std::optional<std::vector<std::vector<double>>> fields::seconds_table_or_null(const char* key) {
  const auto& value = at(key);
  if (value.is_null()) return std::nullopt;
  const auto seconds = [](const nlohmann::json& v) { return v.is_number() && v.get<double>() >= 0; };
  const auto list = [&](const nlohmann::json& v) { return v.is_array() && std::all_of(v.begin(), v.end(), seconds); };
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), list))
    reject(key, "an array of arrays of numbers >= 0, or null");
  return value.get<std::vector<std::vector<double>>>();
}

double fields::positive(const char* key) {
  const double value = number(key);
  if (!(value > 0)) reject(key, "a number > 0");
  return value;
}

int fields::integer(const char* key, int smallest) {
  const auto& value = at(key);
  const auto from = static_cast<std::uint64_t>(smallest);
  const bool fits = is_count(value) && value.get<std::uint64_t>() >= from &&
                    value.get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max();
  if (!fits) reject(key, "an integer >= " + std::to_string(smallest));
  return value.get<int>();
}

std::uint64_t fields::count(const char* key) {
  const auto& value = at(key);
  if (!is_count(value)) reject(key, "an integer >= 0");
  return value.get<std::uint64_t>();
}

std::optional<std::uint64_t> fields::count_or_null(const char* key) {
  if (is_null(key)) return std::nullopt;
  const auto& value = at(key);
  if (!is_count(value)) reject(key, "an integer >= 0 or null");
  return value.get<std::uint64_t>();
}

bool fields::boolean(const char* key) {
  const auto& value = at(key);
  if (!value.is_boolean()) reject(key, "true or false");
  return value.get<bool>();
}

std::string fields::text(const char* key) {
  const auto& value = at(key);
  if (!value.is_string()) reject(key, "a string");
  if (has_controls(value.get_ref<const std::string&>())) reject(key, "a string without control characters");
  return value.get<std::string>();
}

std::optional<std::string> fields::text_or_null(const char* key) {
  const auto& value = at(key);
  if (value.is_null()) return std::nullopt;
  if (!value.is_string()) reject(key, "a string or null");
  return text(key);
}

namespace {

bool is_text_list(const nlohmann::json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const nlohmann::json& v) {
           return v.is_string() && !has_controls(v.get_ref<const std::string&>());
         });
}

}  // namespace

std::vector<std::string> fields::texts(const char* key) {
  const auto& value = at(key);
  if (!is_text_list(value)) reject(key, "an array of strings without control characters");
  return value.get<std::vector<std::string>>();
}

std::vector<std::vector<std::string>> fields::text_table(const char* key, std::size_t columns) {
  const auto& value = at(key);
  const auto row = [columns](const nlohmann::json& v) { return is_text_list(v) && v.size() == columns; };
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), row))
    reject(key, "an array of arrays of " + std::to_string(columns) + " strings without control characters");
  return value.get<std::vector<std::vector<std::string>>>();
}

std::string fields::hex(const char* key) {
  std::string value = text(key);
  if (!is_hex(value)) throw error("key \"" + prefix_ + key + "\" should be 16 hex digits, is \"" + value + "\"");
  return value;
}

std::optional<std::string> fields::hex_or_null(const char* key) {
  if (is_null(key)) return std::nullopt;
  return hex(key);
}

std::string fields::utc(const char* key) {
  std::string value = text(key);
  if (!is_utc(value))
    throw error("key \"" + prefix_ + key + "\" should be a UTC time like 2026-11-22T15:30:00.123Z, is \"" + value +
                "\"");
  return value;
}

std::string fields::word(const char* key, std::initializer_list<const char*> words) {
  const auto& value = at(key);
  if (value.is_string() && std::find(words.begin(), words.end(), value) != words.end()) return value;
  std::string expected;
  for (const char* const w : words)
    expected += (expected.empty() ? "" : w == *(words.end() - 1) ? " or " : ", ") + ('"' + std::string(w) + '"');
  throw error("key \"" + prefix_ + key + "\" should be " + expected + ", is " +
              (value.is_string() ? value.dump() : describe(value)));
}

}  // namespace pairsum::harness
