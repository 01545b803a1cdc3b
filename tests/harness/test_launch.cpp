#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/run/launch.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/verify/shared_store.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

class launch : public study_test {
 protected:
  launch() { order_.plan = study_of({small_part("a", 1)}); }

  /// A program made of these lines of shell.
  std::filesystem::path program(const std::string& lines, const char* first = "#!/bin/sh\n") const {
    const auto path = folder_ / "program";
    write_text(path, first + lines);
    chmod(path.c_str(), 0755);
    return path;
  }

  departure launched(const std::string& lines) const { return in_a_process(program(lines))(order_); }

  static void expect_refused(const std::function<void()>& f) {
    try {
      f();
      ADD_FAILURE() << "accepted";
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find("no program that can be run"), std::string::npos) << e.what();
    }
  }

  order order_;
};

TEST_F(launch, says_how_the_process_ended) {
  EXPECT_EQ(launched("exit 0").code, 0);
  EXPECT_EQ(launched("exit 1").code, 1);
  EXPECT_EQ(launched("exit 130").code, 130);
  const departure killed = launched("kill -9 $$");
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_EQ(killed.code, 0);
  EXPECT_GT(launched("i=0; while [ $i -lt 30000 ]; do i=$((i+1)); done").cpu_s, 0);
}

TEST_F(launch, work_is_done_if_the_process_says_so) {
  for (const char* lines : {"exit 0", "exit 1", "printf 'done 0'; exit 0"}) EXPECT_FALSE(launched(lines).done) << lines;
  const std::string say = "printf '\\ndone 1' >> /proc/self/fd/$2; ";
  const departure end = launched(say + "exit 0");
  EXPECT_TRUE(end.done);
  EXPECT_EQ(end.code, 1) << "what it said counts";
  EXPECT_EQ(launched(say + "kill -9 $$").signal, SIGKILL);
}

TEST_F(launch, hands_the_order_and_the_store_on) {
  const auto seen = folder_ / "seen", stored = folder_ / "stored";
  shared_store store;
  store.save("key", "bytes");
  order_.round = 42;
  order_.store = store.descriptor();
  order_.known = {{"0123456789abcdef"}, {{"0123456789abcdef", "naive"}}};
  launched("[ \"$1\" = worker ] && cat /proc/self/fd/$2 > " + seen.string() + "\ncat /proc/self/fd/" +
           std::to_string(order_.store) + " > " + stored.string());
  const order there = parse_order(nlohmann::json::parse(text_of(seen)));
  EXPECT_EQ(there.round, 42);
  EXPECT_EQ(there.store, order_.store);
  EXPECT_EQ(there.known.environments, order_.known.environments);
  EXPECT_EQ(there.known.backends, order_.known.backends);
  EXPECT_EQ(plan_hash(there.plan), plan_hash(order_.plan));
  EXPECT_NE(text_of(stored).find("keybytes"), std::string::npos);
}

TEST_F(launch, refuses_what_cannot_be_run) {
  expect_refused([&] { in_a_process(folder_ / "none"); });
  expect_refused([&] { in_a_process("/"); });
  write_text(folder_ / "text", "text");
  expect_refused([&] { in_a_process(folder_ / "text"); });
  const launcher not_a_program = in_a_process(program("text", ""));  // may be executed, but cannot
  expect_refused([&] { not_a_program(order_); });
}

TEST_F(launch, hands_an_interrupt_on) {
  note_interrupts();
  // The process asks the one that launched it to stop, as a user would, and waits for the answer.
  const departure end =
      launched("trap 'exit 130' TERM\nkill -TERM $PPID\ni=0\nwhile [ $i -lt 500 ]; do sleep 0.02; i=$((i+1)); done");
  EXPECT_TRUE(interrupted());
  EXPECT_EQ(end.code, 130);
  std::signal(SIGINT, SIG_DFL);
  note_interrupts();
  EXPECT_FALSE(interrupted());
}

TEST_F(launch, names_the_running_program) {
  EXPECT_TRUE(std::filesystem::equivalent(this_program(), "/proc/self/exe"));
}

TEST(shell_word, is_one_word_and_one_line) {
  EXPECT_EQ(shell_word("a/b.jsonl"), "a/b.jsonl");
  EXPECT_EQ(shell_word("a b'c"), "'a b'\\''c'");
  EXPECT_EQ(shell_word("a\n\x1b[31m'"), "$'a\\012\\033[31m\\''");
  EXPECT_EQ(shell_word("\x9b m\xc2\x9b"), "$'\\233 m\\302\\233'");
  EXPECT_EQ(shell_word("\xc3\xa4 b"), "'\xc3\xa4 b'");
}

}  // namespace
}  // namespace pairsum::harness
