#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/plan/levels.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

TEST(words, repeated_words_count_once) {
  EXPECT_EQ(parse_words("--backend", "b,a,b,a"), (std::vector<std::string>{"b", "a"}));
}

TEST(words, lists_ranges_and_all) {
  EXPECT_EQ(parse_counts("--M", "6,7", 0), (std::vector<int>{6, 7}));
  EXPECT_EQ(parse_counts("--M", "5..8,7,2", 0), (std::vector<int>{5, 6, 7, 8, 2}));
  EXPECT_EQ(parse_counts("--threads", "all", 6), (std::vector<int>{1, 2, 4, 6}));
  EXPECT_EQ(parse_counts("--threads", "all", 1), (std::vector<int>{1}));
  EXPECT_EQ(parse_numbers("--dx", "0.02,3e-2"), (std::vector<double>{0.02, 0.03}));
}

TEST(words, threads_of_all_ranks_are_shared) {
  run_request r;
  ASSERT_TRUE(read_level(r, "threads", "1,cores/ranks,2", 6));
  EXPECT_EQ(r.threads, (std::vector<int>{1, 2}));
  EXPECT_EQ(r.shared_threads, (std::vector<int>{6}));
  EXPECT_EQ(levels_json(r)["threads"], nlohmann::json({1, 2, "6/ranks"}));
  run_request same;
  ASSERT_TRUE(read_level(same, "threads", levels_json(r)["threads"], 2));  // on another machine
  EXPECT_EQ(same.threads, r.threads);
  EXPECT_EQ(same.shared_threads, r.shared_threads);
  EXPECT_THROW(read_level(r, "threads", "x/ranks", 6), error);
  EXPECT_THROW(read_level(r, "threads", "/ranks", 6), error);
}

TEST(words, what_is_no_number_is_named_with_its_option) {
  for (const char* bad : {"x", "6;7", "6,", "", "7..5", "1.5", "99999999999999", "5.."}) {
    try {
      parse_counts("--M", bad, 0);
      ADD_FAILURE() << bad << " was accepted";
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find("--M"), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(parse_numbers("--dx", "0.02x"), error);
  EXPECT_THROW(parse_counts("--M", "all", 0), error);
}

TEST(words, more_than_anybody_means_are_refused) {
  std::string list = "1";
  for (int k = 2; k <= 100000; ++k) list += "," + std::to_string(k);
  EXPECT_THROW(parse_numbers("--dx", list), error);
  EXPECT_EQ(parse_numbers("--dx", list.substr(0, list.find(",1001"))).size(), 1000u);
  EXPECT_THROW(parse_words("--backend", std::string(201, 'a')), error);
}

TEST(words, a_list_where_one_number_is_wanted_is_not_cut) {
  run_request r;
  for (const char* key : {"steps", "repetitions", "dim", "H", "dt"}) {
    try {
      read_level(r, key, "2,3", 1);
      ADD_FAILURE() << key << " took a list";
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find(key), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("one number"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace pairsum::harness
