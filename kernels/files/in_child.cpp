#include <pairsum/files/in_child.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <string_view>
#include <type_traits>

#include <pairsum/core/error.hpp>
#include <pairsum/files/column_room.hpp>

namespace pairsum::files {
namespace {

/// The pipe ended before the message did: the child died.
struct broken {};

/// One end of a pipe: the child writes what the parent reads, member by member. A column that was written is freed at
/// once, so that the columns of a file are in memory twice at most.
class pipe_end {
 public:
  pipe_end(int file, bool writes) : file_(file), writes_(writes) {}

  template <class T>
  void pass(T& a) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&a, sizeof a);
  }
  void pass(std::string& a) {
    elements(a, [&] { bytes(a.data(), a.size()); });
  }
  void pass(fact& a) { each(a.what, a.value, a.how, a.from); }
  template <class T>
  void pass(std::vector<T>& a) {
    elements(a, [&] {
      if constexpr (std::is_trivially_copyable_v<T>) {
        bytes(a.data(), a.size() * sizeof(T));
      } else {
        for (T& one : a) pass(one);
      }
    });
    if (writes_) std::vector<T>().swap(a);
  }
  template <class T, std::size_t n>
  void pass(std::array<std::vector<T>, n>& a) {
    for (auto& one : a) pass(one);
  }
  void pass(std::map<std::string, std::vector<double>>& a) {
    std::size_t n = a.size();
    pass(n);
    for (auto& [name, column] : a) {
      std::string key = name;
      each(key, column);
    }
    for (; !writes_ && a.size() < n;) {
      std::string key;
      pass(key);
      pass(a[key]);
    }
  }
  void pass(file_content& c) {
    each(c.format, c.dialect, c.label, c.x, c.v, c.rho, c.m, c.h, c.kind, c.others, c.dim, c.H, c.dx, c.h_of_all,
         c.m_of_all, c.m_of_boundary, c.rho0, c.B, c.gravity, c.support, c.time, c.box_low, c.box_high, c.periodic,
         c.periodic_by_habit, c.kinds_by_name, c.facts, c.more, c.groups, c.parts);
  }

 private:
  template <class... T>
  void each(T&... a) {
    (pass(a), ...);
  }
  static void room(std::string& a, std::size_t n) { a.resize(n); }
  template <class T>
  static void room(std::vector<T>& a, std::size_t n) {
    resize_column(a, n);
  }
  template <class C, class F>
  void elements(C& a, F&& f) {
    std::size_t n = a.size();
    pass(n);
    if (!writes_) room(a, n);
    f();
  }
  void bytes(void* at, std::size_t n) {
    auto* p = static_cast<char*>(at);
    while (n > 0) {
      const ssize_t moved = writes_ ? write(file_, p, n) : read(file_, p, n);
      if (moved < 0 && errno == EINTR) continue;
      if (moved <= 0) throw broken();
      p += moved;
      n -= static_cast<std::size_t>(moved);
    }
  }

  int file_;
  bool writes_;
};

/// The child: it says nothing, dies of what kills a process, and after `limit_s`. Never returns.
[[noreturn]] void be_child(int pipe, pid_t parent, unsigned limit_s, const std::function<file_content()>& read) {
  for (const int s : {SIGALRM, SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPIPE}) signal(s, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  const rlimit no_core{};
  setrlimit(RLIMIT_CORE, &no_core);
  if (const int nowhere = open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int said : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, said);
  alarm(limit_s);
  pipe_end out(pipe, true);
  std::string problem;
  try {
    file_content content;
    try {
      content = read();
    } catch (const std::bad_alloc&) {
      problem = "there is not enough memory for it";
    } catch (const std::exception& e) {
      problem = e.what();
    }
    out.pass(problem);
    if (problem.empty()) out.pass(content);
  } catch (const broken&) {
    _exit(1);
  }
  _exit(0);
}

/// What became of a child that said nothing.
std::string death(int status, unsigned limit_s) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return "its reader did not come to an end within " + std::to_string(limit_s) + " s; is it damaged?";
  const std::string how = WIFSIGNALED(status) ? "died of signal " + std::to_string(WTERMSIG(status)) + " (" +
                                                    strsignal(WTERMSIG(status)) + ")"
                                              : "ended with exit code " + std::to_string(WEXITSTATUS(status));
  return "its reader " + how + "; the file is damaged, or the reader's library is";
}

}  // namespace

file_content in_child(const std::string& path, unsigned limit_s, const std::function<file_content()>& read) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw error("cannot read " + path + ": no pipe: " + std::strerror(errno));
  fcntl(ends[1], F_SETPIPE_SZ, 1 << 20);  // fewer changes between the two; as large as the system lets it be
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    const int why = errno;
    close(ends[0]);
    close(ends[1]);
    throw error("cannot read " + path + ": no process for it: " + std::strerror(why));
  }
  if (child == 0) {
    close(ends[0]);
    be_child(ends[1], parent, limit_s, read);
  }
  close(ends[1]);
  file_content content;
  std::string problem;
  bool whole = true;
  try {
    pipe_end in(ends[0], false);
    in.pass(problem);
    if (problem.empty()) in.pass(content);
  } catch (const broken&) {
    whole = false;
  } catch (const std::bad_alloc&) {
    problem = "there is not enough memory for it";
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!whole) throw error("cannot read " + path + ": " + death(status, limit_s));
  if (!problem.empty()) throw error(problem.starts_with(path) ? problem : "cannot read " + path + ": " + problem);
  return content;
}

}  // namespace pairsum::files
