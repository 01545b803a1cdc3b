#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/rows/json_file.hpp"
#include "tests/rows/scratch.hpp"

namespace pairsum::harness {
namespace {

std::string refusal(const std::string& text) {
  return message_of([&] { parse_json(text, "f.json"); });
}

TEST(json_file, takes_a_byte_order_mark_and_lines_of_windows) {
  EXPECT_EQ(parse_json("\xEF\xBB\xBF{\r\n\"a\": [1, 2.5, \"\xC3\xA4\"],\r\n\"b\": null}\r\n", "f.json"),
            nlohmann::json::parse("{\"a\": [1, 2.5, \"\xC3\xA4\"], \"b\": null}"));
}

TEST(json_file, names_line_and_column_of_what_is_no_json) {
  EXPECT_EQ(refusal("{\n  \"a\": }").substr(0, 31), "f.json:2:8: this is no JSON: sy");
  EXPECT_EQ(refusal("{\r\n  \"\xC3\xA4\": }").substr(0, 12), "f.json:2:8: ") << "characters, not bytes";
  EXPECT_EQ(refusal("\xEF\xBB\xBF[1, ]").substr(0, 12), "f.json:1:5: ") << "the mark has no column";
  EXPECT_EQ(refusal("]").substr(0, 12), "f.json:1:1: ");
  EXPECT_EQ(refusal("\n\n]").substr(0, 12), "f.json:3:1: ");
  EXPECT_EQ(refusal("{\"a\": 1").substr(0, 12), "f.json:1:7: ") << "it ends too early";
  EXPECT_EQ(refusal("{\"a\": \"\xFF\"}").substr(0, 12), "f.json:1:8: ") << "no UTF-8";
  EXPECT_NE(refusal("{\"a\": }").find("unexpected '}'"), std::string::npos) << refusal("{\"a\": }");
}

TEST(json_file, refuses_a_key_that_is_there_twice) {
  EXPECT_EQ(refusal("{\"a\": 1,\n \"b\": {\"a\": 2},\n \"a\": 3}"),
            "f.json:3:2: key \"a\" is there twice in its object");
  EXPECT_EQ(refusal(R"({"\"": 1, "\"": 2})"), R"(f.json:1:11: key "\"" is there twice in its object)");
  EXPECT_EQ(refusal(R"({"": 1, "": 2})"), R"(f.json:1:9: key "" is there twice in its object)");
  EXPECT_EQ(parse_json(R"([{"a": 1}, {"a": 1}, {"b": {"a": 1}, "a": 1}])", "f.json").size(), 3u);
}

TEST(json_file, finds_a_key_that_is_there_twice_in_what_was_parsed) {
  const auto doubled = [](const std::string& text) { return doubled_key(text, nlohmann::json::parse(text)); };
  EXPECT_EQ(doubled(R"({"a":1,"b":{"a":2},"a":3})"), R"(key "a" is there twice in its object)");
  EXPECT_EQ(doubled(R"({"b":[{"a" :1,"a" :2}]})"), R"(key "a" is there twice in its object)");
  EXPECT_EQ(doubled(R"({"\"":":","\"":1})"), R"(key "\"" is there twice in its object)");
  for (const char* fine :
       {R"([{"a":1},{"a":1},{"b":{"a":1},"a":1}])", R"({"a":":\":","b":"\"\":"})", R"(":")", "[]", "1"})
    EXPECT_EQ(doubled(fine), std::nullopt) << fine;
}

TEST(json_file, refuses_what_no_number_holds) {
  EXPECT_EQ(refusal("{\"a\":\n1e400}"), "f.json:2:6: a number is out of range");
  EXPECT_EQ(parse_json("[1e308, 18446744073709551615]", "f.json")[1], 18446744073709551615u);
}

TEST(json_file, refuses_other_encodings_and_what_is_no_text) {
  using namespace std::string_literals;
  for (const std::string& text : {"\xFF\xFE{\0}\0"s, "\xFE\xFF\0{\0}"s, "{\0}\0"s, "\0{\0}"s})
    EXPECT_EQ(refusal(text), "f.json: is UTF-16, should be UTF-8");
  for (const std::string& text : {std::string(1000, '\0'), "{}\0"s})
    EXPECT_EQ(refusal(text), "f.json: has NUL bytes, should be JSON, which is text");
  for (const char* const text : {"", " \r\n", "\xEF\xBB\xBF"})
    EXPECT_EQ(refusal(text), "f.json: is empty, should be JSON");
}

TEST(json_file, refuses_more_levels_than_a_reader_has_stack_for) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_TRUE(parse_json(nested(32), "f.json").is_array());
  for (const std::size_t n : {33, 80000, 10000000})
    EXPECT_EQ(refusal(nested(n)), "f.json:1:33: more than 32 levels of lists and objects");
  std::string objects;
  for (int k = 0; k < 80000; ++k) objects += "{\"a\":";
  EXPECT_EQ(refusal(objects), "f.json:1:161: more than 32 levels of lists and objects");
}

TEST(json_file, names_what_cannot_be_read) {
  const auto said = [](const char* path) { return message_of([&] { read_json_file(path, "a plan"); }); };
  EXPECT_EQ(said("/none.json"),
            "/none.json: cannot be read: No such file or directory, should be a plan (a JSON file)");
  EXPECT_EQ(said("/"), "/: is a folder, should be a plan (a JSON file)");
  EXPECT_EQ(said("/dev/zero"), "/dev/zero: has more than 16 MB, should be a plan (a JSON file)")
      << "and is not read on";
  EXPECT_EQ(said("/dev/null"), "/dev/null: is empty, should be JSON");
}

}  // namespace
}  // namespace pairsum::harness
