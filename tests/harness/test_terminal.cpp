#include <gtest/gtest.h>

#include <cstdio>

#include "harness/terminal/program.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

TEST(terminal, a_file_has_no_colours_and_the_usual_width) {
  std::FILE* const file = std::tmpfile();
  EXPECT_FALSE(is_terminal(file));
  EXPECT_FALSE(has_colours(file));
  EXPECT_EQ(columns_of(file), 80);
  std::fclose(file);
}

TEST(terminal, cuts_characters_and_not_bytes) {
  EXPECT_EQ(cut_to("abc", 2), "ab");
  EXPECT_EQ(cut_to("abc", 9), "abc");
  EXPECT_EQ(cut_to("\u00b1\u00b1x", 1), "\u00b1");
  EXPECT_EQ(cut_to("abc", 0), "");
  EXPECT_EQ(columns_in("\u00b1x"), 2u);
}

TEST(terminal, colours_are_there_or_not) {
  EXPECT_EQ(coloured(tone::good, "x", false), "x");
  EXPECT_EQ(coloured(tone::good, "x", true), "\x1b[32mx\x1b[0m");
}

TEST(one_line, shows_what_would_steer_a_terminal) {
  EXPECT_EQ(one_line("plain text, \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80"),
            "plain text, \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(one_line("1\n2\t\x1b[31m\x7f"), "1\\n2\\x09\\x1b[31m\\x7f");
  EXPECT_EQ(one_line("\xC2\x9B"
                     "31m"),
            "\\xc2\\x9b31m")
      << "CSI as one character";
  EXPECT_EQ(one_line("\x9B"
                     "31m \xFF \xC3"),
            "\\x9b31m \\xff \\xc3")
      << "no UTF-8";
  EXPECT_EQ(one_line(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(one_line("\u202Evsc.a \uFEFF\u2028\u061C"), "\\xe2\\x80\\xaevsc.a \\xef\\xbb\\xbf\\xe2\\x80\\xa8\\xd8\\x9c")
      << "what turns the direction of writing";
  for (const char* const text : {"\u00AD", "\u200B", "\u200F", "\u2029", "\u2066", "\u2069", "\U000E0041",
                                 "\xF0\x82\x80\xAE", "\xE0\x80\x8A", "\xF5\x80\x80\x80"})
    EXPECT_TRUE(one_line(text).starts_with("\\x")) << one_line(text);
  EXPECT_EQ(one_line("\u200D\u0627\u200C"), "\u200D\u0627\u200C") << "joiners of letters";
}

TEST(one_line, cuts_long_words_and_the_whole) {
  const std::string word = one_line("unknown isa \"" + std::string(1000000, 'a') + "\"; valid: scalar");
  EXPECT_LT(word.size(), 400u);
  EXPECT_TRUE(word.ends_with("[...] valid: scalar")) << "what would be right is still there";
  std::string many;
  for (int k = 0; k < 100000; ++k) many += "a b ";
  EXPECT_LT(one_line(many).size(), 3100u);
  EXPECT_EQ(one_line(std::string(200, 'a')), std::string(200, 'a'));
}

TEST(progress, never_goes_back_though_estimates_change) {
  standing at{.elapsed_s = 5, .done_s = 0, .this_s = 10, .all_s = 100, .text = ""};
  progress line(at);
  EXPECT_DOUBLE_EQ(line.share(0), 0);
  EXPECT_DOUBLE_EQ(line.share(10), 0.1);
  at = {.elapsed_s = 15, .done_s = 10, .this_s = 90, .all_s = 1000, .shown = 0.1, .text = ""};  // ten times the work
  line.begin(at);
  EXPECT_DOUBLE_EQ(line.share(10), 0.1);
  EXPECT_GT(line.share(11), 0.1);
  EXPECT_DOUBLE_EQ(line.share(1000), 1);
  at = {.elapsed_s = 95, .done_s = 100, .this_s = 5, .all_s = 50, .shown = 0.2, .text = ""};  // less than was done
  line.begin(at);
  EXPECT_DOUBLE_EQ(line.share(105), 1);
}

}  // namespace
}  // namespace pairsum::harness
