#include "harness/run/job_launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include <pairsum/core/error.hpp>
#include "harness/measure/cpu_time.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/child.hpp"

namespace pairsum::harness {
namespace {

/// What the first rank writes, without the lines that it writes for us.
class job_output {
 public:
  void take(std::string_view text) {
    rest_ += text;
    while (true) {
      const std::size_t at = rest_.find(job_mark.front());
      print(std::string_view(rest_).substr(0, at));
      rest_.erase(0, at);
      const std::size_t end = rest_.find('\n');
      if (at == rest_.npos || end == rest_.npos) return;
      read(std::string_view(rest_).substr(0, end));
      rest_.erase(0, end + 1);
    }
  }

  bool begun() const { return begun_; }
  std::optional<int> code_when_done() const { return done_; }

 private:
  static void print(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
  void read(std::string_view line) {
    if (!line.starts_with(job_mark)) return print(std::string(line) + "\n");
    const std::string word(line.substr(job_mark.size()));
    begun_ = begun_ || word.starts_with(job_begun);
    if (word.starts_with(job_done)) done_ = std::atoi(word.c_str() + job_done.size());
  }

  std::string rest_;
  bool begun_ = false;
  std::optional<int> done_;
};

/// What mpirun shall do: let this program bind, start more ranks than it counts slots, and spin where each rank has
/// its cores. Other launchers do not know these words. What the user has set stays.
void set_environment(bool crowded) {
  const std::pair<const char*, const char*> words[] = {
      {"OMPI_MCA_hwloc_base_binding_policy", "none"},
      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
      {"OMPI_MCA_mpi_yield_when_idle", crowded ? "1" : "0"},
      {"PRTE_MCA_hwloc_default_binding_policy", "none"},
      {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"},
  };
  for (const auto& [name, value] : words) ::setenv(name, value, 0);
  if (::isatty(STDOUT_FILENO) == 0) ::setenv("NO_COLOR", "1", 0);  // a launcher may give ranks a terminal of its own
}

/// Reads what the job writes until it ends; ranks that outlive their launcher may keep the pipe open.
departure listen(pid_t child, int pipe, job_output& heard) {
  constexpr int look_ms = 100;
  forwarded_interrupt interrupt(child);
  std::array<char, 65536> part{};
  std::optional<departure> end;
  bool open = true;
  while (open || !end) {
    interrupt.look();
    pollfd ready{pipe, POLLIN, 0};
    const int events = open ? ::poll(&ready, 1, look_ms) : (::usleep(1000), 0);
    if (events > 0) {
      const ssize_t n = ::read(pipe, part.data(), part.size());
      if (n > 0) heard.take({part.data(), static_cast<std::size_t>(n)});
      open = n > 0 || (n < 0 && errno == EINTR);
    } else if (end) {
      open = false;
    }
    int status = 0;
    rusage use{};
    if (!end && ::wait4(child, &status, WNOHANG, &use) == child) end = departure_of(status, cpu_time_of(use));
  }
  return *end;
}

/// As root Open MPI starts nothing unless it is told to.
std::string hint_for_root(const std::string& name) {
  if (name.find("mpi") == name.npos || ::geteuid() != 0 || std::getenv("OMPI_ALLOW_RUN_AS_ROOT") != nullptr) return "";
  return "; as root Open MPI wants OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1";
}

int number_of(const char* name, int otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr || *text < '0' || *text > '9' ? otherwise : std::atoi(text);
}

}  // namespace

std::vector<std::string> launcher_words(const std::string& launcher, int ranks) {
  std::vector<std::string> words;
  std::istringstream text(launcher);
  for (std::string word; text >> word;) words.push_back(word);
  if (words.empty()) throw error("--launcher takes the words that start a job, like mpirun, not \"\"");
  const std::string name = std::filesystem::path(words.front()).filename().string();
  words.insert(words.end(), {"-n", std::to_string(ranks)});
  if (name.starts_with("mpi") || name == "orterun" || name == "prterun")
    words.insert(words.end(), {"--bind-to", "none"});
  if (name == "srun") {
    words.emplace_back("--cpu-bind=none");
    if (std::getenv("SLURM_STEP_ID") != nullptr) words.emplace_back("--overlap");
  }
  return words;
}

departure run_job(const std::string& launcher, const std::filesystem::path& program, int ranks,
                  const std::vector<std::string>& words, const std::string& input, bool crowded) {
  std::vector<std::string> all = launcher_words(launcher, ranks);
  const std::string name = all.front();
  all.push_back(std::filesystem::canonical(program).string());  // /proc/self/exe would be the launcher
  all.emplace_back("job");
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw error(fmt::format("cannot listen to a job: {}", std::strerror(errno)));
  const int in = file_of("pairsum-input", input);
  std::fflush(stdout);
  const pid_t child = start_child(SIGTERM, [&] {
    set_environment(crowded);
    ::dup2(in, STDIN_FILENO);
    ::dup2(ends[1], STDOUT_FILENO);
    ::execvp(arguments.front(), arguments.data());
  });
  ::close(in);
  ::close(ends[1]);
  job_output heard;
  departure end = listen(child, ends[0], heard);
  ::close(ends[0]);
  if (end.code == cannot_run && !heard.begun())
    throw error(fmt::format("{} is no program that can be run: --launcher names what starts MPI jobs here", name));
  constexpr int by_signal = 128, most_signals = 64;  // how a launcher tells of a rank that a signal ended
  if (const auto code = heard.code_when_done()) {
    end = {*code, 0, end.cpu_s, true};
  } else if (end.code > by_signal && end.code <= by_signal + most_signals) {
    end.signal = end.code - by_signal;
    end.code = 0;
  } else if (!heard.begun() && end.signal == 0) {
    throw error(fmt::format("{} started no rank of {} (exit code {}){}", name, ranks, end.code, hint_for_root(name)));
  }
  return end;
}

outer_job outer_job_here() {
  constexpr std::pair<const char*, const char*> names[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                                           {"PMI_SIZE", "PMI_RANK"},
                                                           {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
  for (const auto& [size, rank] : names)
    if (const outer_job job{number_of(size, 1), number_of(rank, -1)}; job.size > 1 && job.rank >= 0) return job;
  return {};
}

void leave_outer_job() {
  constexpr std::string_view of_job[] = {"OMPI_", "PMIX_", "PMI_", "ORTE_", "PRTE_", "OPAL_", "MPI_LOCAL", "HYDRA_"};
  constexpr std::string_view of_user[] = {"OMPI_ALLOW_", "OMPI_MCA_btl", "OMPI_MCA_pml", "OMPI_MCA_mtl",
                                          "OMPI_MCA_coll"};
  const auto begins = [](std::string_view name, const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return name.starts_with(word); });
  };
  std::vector<std::string> names;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable, name = text.substr(0, text.find('='));
    if (begins(name, of_job) && !begins(name, of_user)) names.emplace_back(name);
  }
  for (const std::string& name : names) ::unsetenv(name.c_str());
  ::unsetenv("SLURM_STEP_NUM_TASKS");  // srun starts steps of its own
}

}  // namespace pairsum::harness
