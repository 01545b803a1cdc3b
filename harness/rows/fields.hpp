#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace pairsum::harness {

/// Strict access to the keys of one JSON object: every getter throws pairsum::error naming the full
/// key (with the prefix of the enclosing objects) if the key is missing or of another type, and
/// finish() throws if the object has a key that no getter asked for.
class fields {
 public:
  /// @param prefix what to put before the keys in messages, like "phases."
  explicit fields(const nlohmann::json& object, std::string prefix = "");

  bool has(const char* key) const { return object_.contains(key); }
  bool is_null(const char* key);
  /// The nested object, with the prefix extended by `key`.
  fields nested(const char* key);

  /// The objects of a list, each with its place in the prefix.
  std::vector<fields> objects(const char* key);

  double number(const char* key);
  std::optional<double> number_or_null(const char* key);
  /// A number >= 0 or null.
  std::optional<double> amount_or_null(const char* key);
  /// A list of lists of seconds, or null.
  std::optional<std::vector<std::vector<double>>> seconds_table_or_null(const char* key);
  /// A number > 0.
  double positive(const char* key);
  int integer(const char* key, int smallest);
  std::uint64_t count(const char* key);
  std::optional<std::uint64_t> count_or_null(const char* key);
  bool boolean(const char* key);
  /// A text without control characters.
  std::string text(const char* key);
  std::optional<std::string> text_or_null(const char* key);
  /// A list of texts without control characters.
  std::vector<std::string> texts(const char* key);
  /// A list of lists of `columns` such texts.
  std::vector<std::vector<std::string>> text_table(const char* key, std::size_t columns);
  /// 16 lower-case hex digits.
  std::string hex(const char* key);
  std::optional<std::string> hex_or_null(const char* key);
  /// A UTC time like 2026-11-22T15:30:00.123Z.
  std::string utc(const char* key);
  /// One of these words.
  std::string word(const char* key, std::initializer_list<const char*> words);
  /// Throws unless the key holds exactly this text.
  void literal(const char* key, const char* expected) { word(key, {expected}); }

  /// Throws if the object has a key that was not asked for.
  void finish() const;
  /// Throws the message for a key: `key "prefix.key" should be EXPECTED, is FOUND`.
  [[noreturn]] void reject(const char* key, const std::string& expected) const;
  const nlohmann::json& at(const char* key);

 private:
  const nlohmann::json& object_;
  std::string prefix_;
  std::vector<std::string> asked_;
};

/// Has the text control characters: those of ASCII or, in UTF-8, U+0080 to U+009F, which steer terminals, too?
bool has_controls(const std::string& text);

/// What a JSON value is, in words: "a string", "null", "the number 0.5".
std::string describe(const nlohmann::json& value);

}  // namespace pairsum::harness
