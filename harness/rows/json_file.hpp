#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace pairsum::harness {

/// Throws pairsum::error for a text that begins as UTF-16 does.
void check_encoding(std::string_view beginning, const std::string& name);
/// The text without the byte order mark that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);

/// The JSON value of a text that people edit; a byte order mark of UTF-8 and CR before LF are fine. Throws
/// pairsum::error with one line, `NAME:LINE:COLUMN: what`, where the text is no JSON, says a key of an object twice,
/// has a number that is out of range or more than 32 levels; and `NAME: what` for UTF-16, NUL bytes and no text at all.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// What is wrong with a JSON text that says a key of an object twice, as in the message of parse_json; none if it does
/// not. Takes a small share of the time in which the text was parsed.
/// @param value of the text
std::optional<std::string> doubled_key(std::string_view text, const nlohmann::json& value);

/// The same of a file of at most 16 MB.
/// @param kind what the file should be, for messages: "a plan"
nlohmann::json read_json_file(const std::filesystem::path& path, const std::string& kind);

}  // namespace pairsum::harness
