#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "harness/rows/reader.hpp"
#include "harness/rows/whole_file.hpp"
#include "harness/rows/writer.hpp"
#include "tests/rows/scratch.hpp"
#include "tests/rows/write_sample.hpp"

namespace pairsum::harness {
namespace {

class rows_files : public scratch {
 protected:
  std::filesystem::path write_example(const std::string& name = "rows.jsonl") const {
    row_writer writer(file(name));
    writer.write(example::environment());
    writer.write(example::backend());
    writer.write(example::measured());
    writer.write(example::failed());
    writer.write(example::voided());
    return file(name);
  }
};

TEST_F(rows_files, what_was_written_is_read) {
  const rows_file rows = read_rows(write_example("a/new/folder/rows.jsonl"));
  ASSERT_EQ(rows.samples.size(), 2u);
  ASSERT_EQ(rows.environments.size(), 1u);
  ASSERT_EQ(rows.voids.size(), 1u);
  EXPECT_EQ(rows.samples[0], example::measured());
  EXPECT_EQ(rows.samples[1], example::failed());
  EXPECT_EQ(rows.environments[0], example::environment());
  EXPECT_EQ(rows.backends, std::vector<backend_row>{example::backend()});
  EXPECT_EQ(rows.voids[0], example::voided());
}

TEST_F(rows_files, appending_keeps_the_rows) {
  const auto path = write_example();
  const std::string before = get(path);
  row_writer(path).write(example::measured());
  EXPECT_EQ(get(path), before + format_row(example::measured()) + "\n");
  EXPECT_EQ(read_rows(path).samples.size(), 3u);
}

TEST_F(rows_files, only_samples_of_finished_rounds_are_valid) {
  const auto path = file("rows.jsonl");
  row_writer writer(path);
  writer.write(example::environment());
  sample s = example::measured();
  round_row closing = example::closing(1);
  for (int round = 1; round <= 3; ++round) {
    s.round = closing.round = round;
    write_sample(writer, s);
    writer.write(closing);
  }
  s.study = closing.study = "another";
  s.round = closing.round = 2;
  write_sample(writer, s);
  writer.write(closing);
  s.round = 4;  // never closed
  write_sample(writer, s);
  writer.write(example::voided());  // study talk, round 2
  const rows_file rows = read_rows(path);
  EXPECT_EQ(rows.samples.size(), 5u);
  EXPECT_EQ(rows.finished_rounds().size(), 3u);
  const std::vector<sample> valid = rows.valid_samples();
  ASSERT_EQ(valid.size(), 3u);
  EXPECT_EQ(valid[0].round, 1);
  EXPECT_EQ(valid[1].round, 3);
  EXPECT_EQ(valid[2].study, "another");
  const std::vector<std::pair<std::string, int>> open{{"another", 4}};
  EXPECT_EQ(rows.unfinished_rounds(), open);
}

TEST_F(rows_files, paces_count_with_their_round) {
  const auto path = file("rows.jsonl");
  row_writer writer(path);
  writer.write(example::environment());
  sample s = example::measured();
  pace_row pace = example::pace();
  round_row closing = example::closing(1);
  for (int round = 1; round <= 3; ++round) {
    s.round = closing.round = pace.round = round;
    writer.write(pace);
    write_sample(writer, s);
    writer.write(closing);
  }
  pace.round = 4;  // cut before its first sample
  writer.write(pace);
  writer.write(example::voided());  // round 2
  const rows_file rows = read_rows(path);
  EXPECT_EQ(rows.size(), 1u + 1 + 4 + 3 + 3 + 1);
  const std::vector<pace_row> valid = rows.valid_paces();
  ASSERT_EQ(valid.size(), 2u);
  EXPECT_EQ(valid[0].round, 1);
  EXPECT_EQ(valid[1].round, 3);
  const std::vector<std::pair<std::string, int>> open{{"talk", 4}};
  EXPECT_EQ(rows.unfinished_rounds(), open);
  pace.round = 3;
  writer.write(pace);
  EXPECT_CONTAINS(message_of([&] { read_rows(path); }), "names round 3, which a round row before it has closed");
}

TEST_F(rows_files, a_round_row_must_close_what_is_there) {
  const std::string environment = format_row(example::environment()) + "\n" + format_row(example::backend()) + "\n",
                    one = format_row(example::measured()) + "\n";
  const auto close = [](std::uint64_t rows) { return format_row(example::closing(rows)) + "\n"; };
  EXPECT_NO_THROW(read_rows(put("fine.jsonl", environment + one + one + close(2))));
  EXPECT_CONTAINS(message_of([&] { read_rows(put("few.jsonl", environment + one + close(2))); }),
                  ":4: key \"rows\" should be the number of samples of the round, 1, is 2");
  EXPECT_CONTAINS(message_of([&] { read_rows(put("late.jsonl", environment + close(0) + one)); }),
                  ":4: key \"round\" names round 2, which a round row before it has closed");
  EXPECT_CONTAINS(message_of([&] { read_rows(put("twice.jsonl", environment + one + close(1) + close(1))); }),
                  ":5: key \"round\" names round 2, which is closed already");
}

TEST_F(rows_files, a_cut_last_row_can_be_dropped) {
  const std::string whole = get(write_example());
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (const std::string& cut :
       {whole.substr(0, last + 1), whole.substr(0, whole.size() - 1), whole.substr(0, whole.size() - 5) + "\n"}) {
    const auto path = put("cut.jsonl", cut);
    EXPECT_EQ(rows_reader(path).drop_cut_line(), cut.size() - last);
    EXPECT_EQ(get(path), whole.substr(0, last));
    EXPECT_EQ(rows_reader(path).drop_cut_line(), 0u);
    row_writer(path).write(example::voided());
    EXPECT_EQ(get(path), whole);
  }
  EXPECT_EQ(rows_reader(file("none.jsonl")).drop_cut_line(), 0u);
  EXPECT_CONTAINS(message_of([&] { rows_reader(put("foreign", "text\n")).drop_cut_line(); }), "is no rows file");
}

TEST_F(rows_files, a_cut_last_row_is_reported_and_the_rows_before_it_are_readable) {
  const std::string whole = get(write_example());
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t length = last + 1; length < whole.size(); ++length) {
    const auto path = put("cut.jsonl", whole.substr(0, length));
    const std::string what = message_of([&] { read_rows(path); });
    EXPECT_EQ(what.find(path.string() + ":5: the last line is cut"), 0u) << what;
    EXPECT_CONTAINS(what, "4 whole rows before it");
    EXPECT_EQ(message_of([&] { row_writer writer(path); }), what);
    const rows_file rows = read_rows(path, cut_line::drop);
    EXPECT_TRUE(rows.last_line_cut);
    EXPECT_EQ(rows.size(), 4u);
  }
  EXPECT_EQ(read_rows(put("cut.jsonl", whole.substr(0, last))).size(), 4u);
}

TEST_F(rows_files, a_first_row_that_is_cut_is_told_from_a_foreign_file) {
  for (const row& r : {row(example::environment()), row(example::voided())}) {
    const std::string line = format_row(r);
    for (std::size_t length = 1; length <= line.size(); ++length) {
      const auto path = put("cut.jsonl", line.substr(0, length));
      EXPECT_CONTAINS(message_of([&] { read_rows(path); }), ":1: the last line is cut");
    }
  }
}

TEST_F(rows_files, a_last_line_with_cut_json_and_a_newline_is_cut) {
  const auto path = write_example();
  const auto cut = put("cut.jsonl", get(path) + "{\"kind\":\"sam\n");
  EXPECT_CONTAINS(message_of([&] { read_rows(cut); }), ":6: the last line is cut");
  EXPECT_EQ(read_rows(cut, cut_line::drop).size(), 5u);
}

TEST_F(rows_files, a_killed_writer_leaves_whole_rows) {
  const auto path = file("rows.jsonl");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      row_writer writer(path);
      writer.write(example::environment());
      while (true) write_sample(writer, example::measured());
    } catch (...) {
      ::_exit(1);
    }
  }
  const auto grown = [&path] { return std::filesystem::exists(path) && std::filesystem::file_size(path) > 20000; };
  for (int i = 0; i < 10000 && !grown(); ++i) ::usleep(1000);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_GT(read_rows(path).samples.size(), 2u);
}

TEST_F(rows_files, a_text_is_written_whole_or_not_at_all_and_no_other_file_is_left) {
  const auto path = put("old.json", "old");
  const auto files = [&] { return std::distance(std::filesystem::directory_iterator(path.parent_path()), {}); };
  if (const int file = ::open(path.parent_path().c_str(), O_TMPFILE | O_WRONLY); file < 0)
    GTEST_SKIP() << "this file system has no files without names";
  else
    ::close(file);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {  // which is killed in the midst of the text
    const rlimit most{1000, 1000}, no_core{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &most);
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::signal(SIGXFSZ, SIG_DFL);
    write_whole_file(std::string(5000, 'x'), path);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
  EXPECT_EQ(get(path), "old");
  EXPECT_EQ(files(), 1);
  write_whole_file("new", path);
  EXPECT_EQ(get(path), "new");
  write_whole_file("other", file("a/folder/other.json"));
  EXPECT_EQ(get(file("a/folder/other.json")), "other");
  EXPECT_CONTAINS(message_of([&] { write_whole_file("x", file("a")); }), "cannot write " + file("a").string());
  EXPECT_EQ(files(), 2);
}

TEST_F(rows_files, wrong_rows_name_file_line_and_key) {
  const auto path = write_example();
  nlohmann::json bad = nlohmann::json::parse(format_row(example::measured()));
  bad["phases"]["sum_s"] = "slow";
  const auto wrong = put("wrong.jsonl", get(path) + bad.dump() + "\n" + get(path));
  EXPECT_EQ(message_of([&] { read_rows(wrong); }),
            wrong.string() + ":6: key \"phases.sum_s\" should be a number or null, is a string");
  const auto garbage = put("garbage.jsonl", get(path) + "oops\n" + get(path));
  EXPECT_EQ(message_of([&] { read_rows(garbage); }), garbage.string() + ":6: it is no whole JSON value");
  bad["phases"]["sum_s"] = 1;
  std::string huge = bad.dump();
  huge.replace(huge.find("0.00594"), 7, "1e99999");
  const auto range = put("range.jsonl", get(path) + huge + "\n" + get(path));
  EXPECT_CONTAINS(message_of([&] { read_rows(range); }), ":6: it holds a number out of range");
}

TEST_F(rows_files, a_key_that_is_there_twice_is_refused) {
  std::string twice = format_row(example::measured());
  twice.replace(twice.find("\"sum_s\":"), 8, "\"sum_s\":1,\"sum_s\":");
  const auto path = put("twice.jsonl", get(write_example()) + twice + "\n" + format_row(example::measured()) + "\n");
  EXPECT_EQ(message_of([&] { read_rows(path); }), path.string() + ":6: key \"sum_s\" is there twice in its object");
  const auto last = put("last.jsonl", get(write_example("other.jsonl")) + twice + "\n");
  EXPECT_CONTAINS(message_of([&] { read_rows(last, cut_line::drop); }), ":6: key \"sum_s\"") << "it is no cut line";
}

TEST_F(rows_files, a_sample_needs_its_environment_row_before_it) {
  const auto path = put("rows.jsonl", format_row(example::measured()) + "\n");
  EXPECT_CONTAINS(message_of([&] { read_rows(path); }), "key \"environment\" should name an environment row before it");
}

TEST_F(rows_files, a_sample_needs_its_backend_row_before_it) {
  const std::string environment = format_row(example::environment()) + "\n",
                    measured = format_row(example::measured()) + "\n";
  EXPECT_CONTAINS(message_of([&] { read_rows(put("rows.jsonl", environment + measured)); }),
                  ":2: key \"point.backend\" should name a backend row of its environment before it, is "
                  "\"symmetric_omp\"");
  environment_row other = example::environment();
  other.environment = "00000000000000ff";
  backend_row b = example::backend();
  b.environment = other.environment;
  const std::string of_another = format_row(other) + "\n" + format_row(b) + "\n";
  EXPECT_CONTAINS(message_of([&] { read_rows(put("rows.jsonl", of_another + environment + measured)); }),
                  ":4: key \"point.backend\"");
  EXPECT_CONTAINS(message_of([&] { read_rows(put("rows.jsonl", format_row(b) + "\n")); }), "key \"environment\"");
}

TEST_F(rows_files, a_file_of_schema_2_needs_no_backend_rows) {
  nlohmann::json environment = nlohmann::json::parse(format_row(example::environment())),
                 measured = nlohmann::json::parse(format_row(example::measured()));
  environment["schema"] = measured["schema"] = former_row_schema;
  for (const char* key : {"lost", "threads_worked"}) measured.erase(key);
  for (const char* key : {"flops", "bytes"}) measured["work"].erase(key);
  const rows_file rows = read_rows(put("rows.jsonl", environment.dump() + "\n" + measured.dump() + "\n"));
  EXPECT_EQ(rows.samples.size(), 1u);
  EXPECT_TRUE(rows.former_schema);
  EXPECT_FALSE(read_rows(write_example("new.jsonl")).former_schema);
}

TEST_F(rows_files, a_file_that_grows_is_read_once) {
  const auto path = write_example();
  rows_reader reader(path);
  const std::uint64_t before = bytes_of_rows_read();
  reader.read_on();
  EXPECT_EQ(reader.rows().size(), 5u);
  row_writer writer(path, reader.known());
  for (int k = 0; k < 20; ++k) {
    writer.write(example::measured());
    reader.read_on();
  }
  EXPECT_EQ(reader.rows().samples.size(), 22u);
  EXPECT_EQ(bytes_of_rows_read() - before, std::filesystem::file_size(path));
  EXPECT_EQ(format_row(reader.rows().samples.back()), format_row(read_rows(path).samples.back()));
  put("rows.jsonl", get(path) + "{\"kind\":");
  EXPECT_CONTAINS(message_of([&] { reader.read_on(); }), ":26: the last line is cut");
  EXPECT_EQ(reader.drop_cut_line(), 8u);
  writer.write(example::measured());
  reader.read_on();
  EXPECT_EQ(reader.rows().samples.size(), 23u);
  put("rows.jsonl", get(path) + "oops\n" + format_row(example::measured()) + "\n");
  EXPECT_CONTAINS(message_of([&] { reader.read_on(); }), ":27: it is no whole JSON value");
}

TEST_F(rows_files, a_byte_order_mark_and_lines_of_windows_change_nothing) {
  const rows_file rows = read_rows(write_example());
  std::string text = "\xEF\xBB\xBF";
  for (const char c : get(rows.path)) text += c == '\n' ? "\r\n" : std::string(1, c);
  const rows_file edited = read_rows(put("edited.jsonl", text));
  EXPECT_EQ(edited.samples, rows.samples);
  EXPECT_EQ(edited.environments, rows.environments);
  row_writer(edited.path).write(example::measured());
  EXPECT_EQ(read_rows(edited.path).samples.size(), 3u);
}

TEST_F(rows_files, utf_16_is_named) {
  std::string text = "\xFF\xFE";
  for (const char c : get(write_example())) text += {c, '\0'};
  for (const std::string& one : {text, text.substr(2)})
    EXPECT_EQ(message_of([&] { read_rows(put("wide.jsonl", one)); }),
              file("wide.jsonl").string() + ": is UTF-16, should be UTF-8");
}

TEST_F(rows_files, lines_longer_than_a_read_are_whole_rows) {
  const auto path = write_example();
  environment_row long_one = example::environment();
  long_one.flags = std::string(3000000, 'f');
  for (int k = 0; k < 3; ++k) {
    row_writer(path).write(long_one);
    row_writer(path).write(example::measured());
  }
  const rows_file rows = read_rows(path);
  EXPECT_EQ(rows.samples.size(), 5u);
  EXPECT_EQ(rows.environments.size(), 4u);
  EXPECT_EQ(rows.environments.back().flags.size(), 3000000u);
  put("cut.jsonl", get(path).substr(0, get(path).size() - 1));
  EXPECT_EQ(read_rows(file("cut.jsonl"), cut_line::drop).samples.size(), 4u);
}

TEST_F(rows_files, what_has_no_end_is_not_read_to_it) {
  const std::uint64_t before = bytes_of_rows_read();
  for (const std::string& begin : {std::string(), get(write_example()), std::string("{\"schema\":")}) {
    std::filesystem::resize_file(put("huge.jsonl", begin), std::uintmax_t{4} << 30);
    message_of([&] { read_rows(file("huge.jsonl")); });
  }
  EXPECT_LT(bytes_of_rows_read() - before, std::uint64_t{64} << 20);
}

TEST_F(rows_files, files_that_are_no_rows_are_refused_in_one_line) {
  const std::vector<std::string> foreign{"a,b,c\n1,2,3\n",     "{\"a\":1}\n", "{\"a\":1}", "[1,2]\n", "\n",
                                         "{\n  \"a\": 1\n}\n", "{\"a\": [\n", "text"};
  for (const std::string& text : foreign) {
    const auto path = put("foreign", text);
    const std::string what = message_of([&] { read_rows(path); });
    EXPECT_EQ(what.find(path.string() + ":1: this is no rows file: its first line should be"), 0u) << what;
    EXPECT_EQ(message_of([&] { row_writer writer(path); }), what);
    EXPECT_EQ(get(path), text);
  }
  EXPECT_CONTAINS(message_of([&] { read_rows(put("empty", "")); }), "is empty");
  EXPECT_CONTAINS(message_of([&] { read_rows(file("none")); }), "No such file");
  EXPECT_CONTAINS(message_of([&] { read_rows(folder_); }), "is a folder");
  const auto other = put("other", "{\"schema\":\"pairsum.row/9\",\"kind\":\"void\"}\n");
  EXPECT_EQ(
      message_of([&] { read_rows(other); }),
      other.string() + ":1: key \"schema\" should be \"pairsum.row/3\" or \"pairsum.row/2\", is \"pairsum.row/9\"");
}

TEST_F(rows_files, places_that_cannot_be_written_are_refused_in_one_line) {
  const auto below = put("plain", "text") / "folder" / "rows.jsonl";
  EXPECT_CONTAINS(message_of([&] { row_writer writer(below); }), "cannot write rows to " + below.string() + ": ");
  const std::filesystem::path proc = "/proc/pairsum/rows.jsonl";
  EXPECT_CONTAINS(message_of([&] { row_writer writer(proc); }), "folder /proc/pairsum: ");
  EXPECT_CONTAINS(message_of([&] { row_writer writer(folder_); }), "is a folder");
  EXPECT_CONTAINS(message_of([&] { row_writer writer(folder_ / ""); }), "should name a file");
}

TEST_F(rows_files, a_row_that_could_not_be_read_is_not_written) {
  const auto path = file("rows.jsonl");
  row_writer writer(path);
  EXPECT_CONTAINS(message_of([&] { writer.write(example::measured()); }), "no environment row");
  writer.write(example::environment());
  EXPECT_CONTAINS(message_of([&] { writer.write(example::measured()); }), "no backend row");
  writer.write(example::backend());
  const std::string before = get(path);
  sample s = example::measured();
  s.point.dx = std::nan("");
  EXPECT_CONTAINS(message_of([&] { write_sample(writer, s); }),
                  "the row is wrong: key \"point.dx\" should be a number, is null");
  s = example::measured();
  s.round = 0;
  EXPECT_CONTAINS(message_of([&] { write_sample(writer, s); }), "key \"round\"");
  EXPECT_EQ(get(path), before);
}

TEST_F(rows_files, a_device_is_no_rows_file) {
  EXPECT_CONTAINS(message_of([&] { row_writer writer("/dev/null"); }), "is no regular file");
}

}  // namespace
}  // namespace pairsum::harness
