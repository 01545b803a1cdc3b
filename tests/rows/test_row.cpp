#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "harness/rows/point_words.hpp"
#include "harness/rows/row.hpp"
#include "harness/rows/threads_worked.hpp"
#include "tests/rows/example_rows.hpp"
#include "tests/rows/scratch.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

template <class T>
T round_trip(const T& value) {
  return std::get<T>(parse_row(json::parse(format_row(value))));
}

TEST(row, every_kind_survives_a_round_trip) {
  EXPECT_EQ(round_trip(example::measured()), example::measured());
  EXPECT_EQ(round_trip(example::failed()), example::failed());
  EXPECT_EQ(round_trip(example::of_ranks()), example::of_ranks());
  EXPECT_EQ(round_trip(example::untimed()), example::untimed());
  EXPECT_EQ(round_trip(example::environment()), example::environment());
  EXPECT_EQ(round_trip(example::backend()), example::backend());
  EXPECT_EQ(round_trip(example::particles()), example::particles());
  EXPECT_EQ(round_trip(example::of_files()), example::of_files());
  EXPECT_EQ(round_trip(example::voided()), example::voided());
  EXPECT_EQ(round_trip(example::peak()), example::peak());
  EXPECT_EQ(round_trip(example::pace()), example::pace());
  EXPECT_EQ(round_trip(example::closing()), example::closing());
  EXPECT_EQ(round_trip(example::ended()), example::ended());
  environment_row bare = example::environment();
  bare.governor.reset();
  bare.caches.clear();
  bare.libraries.clear();
  bare.limits.clear();  // as older rows
  EXPECT_EQ(round_trip(bare), bare);
  backend_row plain = example::backend();
  plain.self_test->expected.reset();
  EXPECT_EQ(round_trip(plain), plain);
  plain.self_test.reset();
  EXPECT_EQ(round_trip(plain), plain);
}

TEST(row, one_rank_is_what_older_rows_mean) {
  json j = json::parse(format_row(example::measured()));
  EXPECT_EQ(j["point"]["ranks"], 1);
  EXPECT_FALSE(j["point"].contains("cut"));
  j["point"].erase("ranks");
  EXPECT_EQ(std::get<sample>(parse_row(j)), example::measured());
}

TEST(row, wrong_ranks_are_named) {
  const auto said = [](auto change) {
    json j = json::parse(format_row(example::of_ranks()));
    change(j);
    return message_of([&] { parse_row(j); });
  };
  EXPECT_NO_THROW(parse_row(json::parse(format_row(example::of_ranks()))));
  EXPECT_NE(said([](json& j) { j["ranks"].erase(0); }).find("\"ranks\" should be a list of at least 2 ranks"),
            std::string::npos);
  EXPECT_NE(said([](json& j) { j["ranks"] = 2; }).find("\"ranks\" should be a list of objects"), std::string::npos);
  EXPECT_NE(said([](json& j) { j["ranks"][1]["own"] = -1; }).find("\"ranks[1].own\""), std::string::npos);
  EXPECT_NE(said([](json& j) { j["ranks"][0]["halo"].erase("bytes"); }).find("\"ranks[0].halo.bytes\""),
            std::string::npos);
  EXPECT_NE(said([](json& j) { j["ranks"][0]["more"] = 1; }).find("more"), std::string::npos);
  EXPECT_NE(said([](json& j) { j["point"]["ranks"] = 0; }).find("\"point.ranks\""), std::string::npos);
  EXPECT_NE(said([](json& j) { j["point"]["cut"] = "thrice"; }).find("\"point.cut\""), std::string::npos);
  EXPECT_NE(said([](json& j) { j["untimed"] = "why"; }).find("null in a row with \"untimed\""), std::string::npos);
}

TEST(row, nested_structs_survive_a_round_trip) {
  const sample s = example::measured();
  EXPECT_EQ(json(s.point).get<point>(), s.point);
  EXPECT_EQ(json(*s.phases).get<phases>(), *s.phases);
  EXPECT_EQ(json(*s.work).get<work_row>(), *s.work);
  EXPECT_EQ(json(s.verify).get<verify_row>(), s.verify);
}

TEST(row, texts_have_no_control_characters) {
  for (const char* const text : {"a\nb", "\x1b[31m", "a\x7f", "\xC2\x9B"}) {
    sample s = example::failed();
    s.error = text;
    EXPECT_EQ(message_of([&] { round_trip(s); }),
              "key \"error\" should be a string without control characters, is a string");
  }
  environment_row e = example::environment();
  e.host = "h\xC3\xA4mmer \xC2\xA0";
  EXPECT_EQ(round_trip(e), e);
}

TEST(row, numbers_survive_bit_for_bit) {
  sample s = example::measured();
  s.phases->sum_s = 0.1 + 0.2;
  s.point.dx = std::nextafter(0.00594, 1.0);
  EXPECT_EQ(round_trip(s), s);
}

TEST(row, what_is_not_finite_is_written_as_null) {
  sample s = example::measured();
  s.phases->sum_s = std::nan("");
  s.phases->zero_s = std::numeric_limits<double>::infinity();
  s.verify.max_rel_err = -std::numeric_limits<double>::infinity();
  s.threads_busy_s = thread_times{{1.0}, {std::nan("")}};
  const json j = json::parse(format_row(s));
  EXPECT_TRUE(j["phases"]["sum_s"].is_null());
  EXPECT_TRUE(j["phases"]["zero_s"].is_null());
  EXPECT_TRUE(j["verify"]["max_rel_err"].is_null());
  EXPECT_TRUE(j["threads_busy_s"].is_null());
  EXPECT_EQ(std::get<sample>(parse_row(j)).phases->sum_s, std::nullopt);
}

TEST(row, a_row_is_one_line) {
  void_row v = example::voided();
  v.reason = "two\nlines and a bad byte \xff";
  EXPECT_EQ(format_row(v).find('\n'), std::string::npos);
}

std::string rejection(const row& value, const std::function<void(json&)>& change) {
  json j = json::parse(format_row(value));
  change(j);
  return message_of([&j] { parse_row(j); });
}

TEST(row, every_missing_key_is_named) {
  const json whole = json::parse(format_row(example::measured()));
  for (const auto& item : whole.items()) {
    const std::string key = item.key();
    EXPECT_CONTAINS(rejection(example::measured(), [&](json& j) { j.erase(key); }), "key \"" + key + "\" is missing");
    if (!item.value().is_object()) continue;
    for (const auto& inner : item.value().items()) {
      const std::string inner_key = inner.key();
      if (inner_key == "ranks") continue;  // without, it is one
      EXPECT_EQ(rejection(example::measured(), [&](json& j) { j[key].erase(inner_key); }),
                "key \"" + key + "." + inner_key + "\" is missing");
    }
  }
  for (const row& value :
       {row(example::environment()), row(example::backend()), row(example::voided()), row(example::peak()),
        row(example::pace()), row(example::closing()), row(example::ended())}) {
    const json other = json::parse(format_row(value));
    for (const auto& item : other.items()) {
      const std::string key = item.key();
      if (key == "limits") continue;  // rows of before have none
      EXPECT_EQ(rejection(value, [&](json& j) { j.erase(key); }), "key \"" + key + "\" is missing");
    }
  }
}

/// The example as schema 2 wrote it.
json former() {
  json j = json::parse(format_row(example::measured()));
  j["schema"] = "pairsum.row/2";
  for (const char* key : {"lost", "threads_worked"}) j.erase(key);
  for (const char* key : {"flops", "bytes"}) j["work"].erase(key);
  return j;
}

TEST(row, a_row_of_schema_2_says_nothing_of_what_came_with_schema_3) {
  sample bare = example::measured();
  bare.lost = bare.threads_worked = std::nullopt;
  bare.work->flops = bare.work->bytes = std::nullopt;
  EXPECT_EQ(std::get<sample>(parse_row(former())), bare);
  for (const char* key : {"lost", "threads_worked"}) {
    json j = former();
    j[key] = 1;
    EXPECT_EQ(message_of([&] { parse_row(j); }), "key \"" + std::string(key) + "\" is not known in this kind of row");
  }
  json j = former();
  j["work"]["flops"] = 1.0;
  EXPECT_EQ(message_of([&] { parse_row(j); }), "key \"work.flops\" is not known in this kind of row");
  EXPECT_EQ(rejection(example::backend(), [](json& b) { b["schema"] = "pairsum.row/2"; }),
            "key \"schema\" should be \"pairsum.row/3\", is \"pairsum.row/2\"");
}

TEST(row, a_point_of_before_there_were_blocks_has_none) {
  json j = former();
  j["point"].erase("block");
  EXPECT_EQ(std::get<sample>(parse_row(j)).point, example::measured().point);
  j["point"]["block"] = 4;
  EXPECT_EQ(message_of([&] { parse_row(j); }), "key \"point.block\" should be a string, is the number 4");
}

TEST(row, a_row_of_before_workspaces_were_measured_says_nothing_of_them) {
  json j = former();
  EXPECT_EQ(std::get<sample>(parse_row(j)).workspace_bytes, 9876543u);
  j.erase("workspace_bytes");
  EXPECT_EQ(std::get<sample>(parse_row(j)).workspace_bytes, std::nullopt);
  for (const json& wrong : {json(-1), json(1.5), json("1")}) {
    j["workspace_bytes"] = wrong;
    EXPECT_NE(message_of([&] { parse_row(j); }), "") << wrong;
  }
}

TEST(row, threads_that_had_next_to_nothing_to_do_did_not_work) {
  EXPECT_EQ(threads_worked({{0.5, 0.4}, {0.5, 0.4}}), 2u);
  EXPECT_EQ(threads_worked({{0.5, 1e-7}, {0.5, 1e-7}}), 1u);
  EXPECT_EQ(threads_worked({{0.5, 1e-7}, {1e-7, 0.5}}), 2u) << "each in a pass of its own";
  EXPECT_EQ(threads_worked({{1.0, 0.011, 0.009}}), 2u);
  EXPECT_EQ(threads_worked({{0.0, 0.0}}), 0u);
  EXPECT_EQ(threads_worked({}), 0u);
}

TEST(row, a_grid_without_M_has_null_and_no_zero) {
  sample s = example::measured();
  s.point.grid = "compact_grid";
  s.point.M = 0;
  json j = json::parse(format_row(s));
  EXPECT_TRUE(j["point"]["M"].is_null());
  EXPECT_EQ(round_trip(s), s);
  j["point"]["M"] = 0;
  EXPECT_EQ(message_of([&] { parse_row(j); }), "key \"point.M\" should be an integer >= 1, is the number 0");
}

TEST(row, a_point_in_words) {
  point p = example::measured().point;
  EXPECT_EQ(place_words(p), "symmetric_omp M=6 threads=2");
  p.backend = "tiles_omp";
  p.grid = "compact_grid";
  p.M = 0;
  p.block = "auto";
  EXPECT_EQ(place_words(p), "tiles_omp compact_grid threads=2");
  p.block = "slab:4";
  p.threads = 1;
  EXPECT_EQ(place_words(p), "tiles_omp compact_grid slab:4 threads=1");
}

TEST(row, every_key_of_another_type_is_named) {
  for (const row& value : {row(example::measured()), row(example::environment()), row(example::voided()),
                           row(example::failed()), row(example::backend()), row(example::peak()), row(example::pace()),
                           row(example::closing()), row(example::ended())}) {
    const json whole = json::parse(format_row(value));
    for (const auto& item : whole.items()) {
      const std::string key = item.key();
      const json wrong = item.value().is_string() ? json(1.5) : json("text");
      EXPECT_CONTAINS(rejection(value, [&](json& j) { j[key] = wrong; }), "key \"" + key + "\" should be ");
      if (!item.value().is_object()) continue;
      for (const auto& inner : item.value().items()) {
        const std::string name = inner.key();
        const json wrong_inner = inner.value().is_string() ? json(1.5) : json("text");
        EXPECT_CONTAINS(rejection(value, [&](json& j) { j[key][name] = wrong_inner; }),
                        "key \"" + key + "." + name + "\" should be ");
      }
    }
  }
}

TEST(row, messages_say_what_is_right_and_what_is_there) {
  const sample s = example::measured();
  EXPECT_EQ(rejection(s, [](json& j) { j["phases"]["sum_s"] = "0.1"; }),
            "key \"phases.sum_s\" should be a number or null, is a string");
  EXPECT_EQ(rejection(s, [](json& j) { j["phases"]["sum_s"] = -1; }),
            "key \"phases.sum_s\" should be a number >= 0 or null, is the number -1");
  EXPECT_EQ(rejection(s, [](json& j) { j["round"] = 0; }), "key \"round\" should be an integer >= 1, is the number 0");
  EXPECT_EQ(rejection(s, [](json& j) { j["step"] = 1.5; }),
            "key \"step\" should be an integer >= 1, is the number 1.5");
  EXPECT_EQ(rejection(s, [](json& j) { j["work"]["cells"] = -3; }),
            "key \"work.cells\" should be an integer >= 0, is the number -3");
  EXPECT_EQ(rejection(s, [](json& j) { j["point"] = json::array(); }),
            "key \"point\" should be an object, is an array");
  EXPECT_EQ(rejection(s, [](json& j) { j["schema"] = "pairsum.row/1"; }),
            "key \"schema\" should be \"pairsum.row/3\" or \"pairsum.row/2\", is \"pairsum.row/1\"");
  EXPECT_EQ(rejection(s, [](json& j) { j["kind"] = "samples"; }),
            "key \"kind\" should be \"sample\", \"environment\", \"backend\", \"peak\", \"pace\", \"round\", \"end\", "
            "\"void\" or \"particles\", is \"samples\"");
  EXPECT_EQ(rejection(s, [](json& j) { j["verify"]["fingerprint"] = "xyz"; }),
            "key \"verify.fingerprint\" should be 16 hex digits, is \"xyz\"");
  EXPECT_EQ(rejection(s, [](json& j) { j["utc"] = "22.11.2026"; }),
            "key \"utc\" should be a UTC time like 2026-11-22T15:30:00.123Z, is \"22.11.2026\"");
  EXPECT_EQ(rejection(s,
                      [](json& j) {
                        j["threads_busy_s"] = {1.0, "a"};
                      }),
            "key \"threads_busy_s\" should be an array of arrays of numbers >= 0, or null, is an array");
}

TEST(row, unknown_keys_are_named) {
  EXPECT_EQ(rejection(example::measured(), [](json& j) { j["note"] = 1; }),
            "key \"note\" is not known in this kind of row");
  EXPECT_EQ(rejection(example::measured(),
                      [](json& j) {
                        j["work"]["vector_units"] = {{"lanes", 8}};
                      }),
            "key \"work.vector_units.block\" is missing");
  EXPECT_EQ(rejection(example::measured(), [](json& j) { j["work"]["pairs"] = 1; }),
            "key \"work.pairs\" is not known in this kind of row");
  EXPECT_EQ(rejection(example::environment(), [](json& j) { j["libraries"]["x"] = 1; }),
            "key \"libraries.x\" should be a string, is the number 1");
}

TEST(row, phases_are_null_exactly_with_an_error) {
  EXPECT_EQ(rejection(example::measured(), [](json& j) { j["phases"] = nullptr; }),
            "key \"phases\" should be an object in a row without \"error\", is null");
  EXPECT_EQ(rejection(example::measured(), [](json& j) { j["error"] = "wrong"; }),
            "key \"phases\" should be null in a row with \"error\", is an object");
}

}  // namespace
}  // namespace pairsum::harness
