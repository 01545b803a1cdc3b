#include "harness/run/by_ranks.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include <pairsum/core/error.hpp>
#include "harness/environment/machine.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/job_launch.hpp"
#include "harness/run/launch.hpp"
#include "harness/terminal/interrupt.hpp"

namespace pairsum::harness {
namespace {

constexpr const char* size_of_outer_job = "PAIRSUM_OUTER_RANKS";

/// The words with which this process was called.
std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

std::optional<int> by_ranks(int ranks, const std::string& launcher, int threads) {
  if (ranks == 1 || here().size() > 1) return std::nullopt;
  note_interrupts();
  std::vector<std::string> words = own_words();
  words.erase(words.begin());
  if (default_ranks() > 1) words.insert(words.end(), {"--ranks", std::to_string(ranks)});
  const departure end =
      run_job(launcher, this_program(), ranks, words, "", ranks * threads > usable_cores() * job_nodes());
  if (interrupted()) return 130;
  if (end.signal != 0) throw error(fmt::format("the job of {} ranks ended: signal {} ended one", ranks, end.signal));
  if (!end.done && end.code != 2)
    throw error(fmt::format("the job of {} ranks ended with code {}, before its work was done", ranks, end.code));
  return end.code;
}

bool left_to_the_first() {
  const outer_job outer = outer_job_here();
  if (outer.size == 1) return false;
  if (outer.rank > 0) return true;
  leave_outer_job();
  ::setenv(size_of_outer_job, std::to_string(outer.size).c_str(), 1);
  ::setenv("NO_COLOR", "1", 0);  // that job may give this process a terminal of its own
  // That job may have bound this process to one core; what started it has all of them.
  cpu_set_t units;
  if (sched_getaffinity(::getppid(), sizeof units, &units) == 0) sched_setaffinity(0, sizeof units, &units);
  std::vector<std::string> words = own_words();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  throw error(fmt::format("cannot start this program outside of its job: {}", std::strerror(errno)));
}

int default_ranks() {
  const char* const text = std::getenv(size_of_outer_job);
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

}  // namespace pairsum::harness
