#include "harness/run/child.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include <pairsum/core/error.hpp>
#include "harness/measure/cpu_time.hpp"
#include "harness/terminal/interrupt.hpp"

namespace pairsum::harness {
namespace {

/// SIGINT and SIGTERM wait while this lives.
class held_signals {
 public:
  held_signals() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGINT);
    sigaddset(&held_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  ~held_signals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  held_signals(const held_signals&) = delete;
  held_signals& operator=(const held_signals&) = delete;

  /// In the child, where such a signal ends the process until it notes them itself.
  void release_in_child() const {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t held_, before_;
};

}  // namespace

pid_t start_child(int signal_of_death, const std::function<void()>& become) {
  const pid_t parent = ::getpid();
  const held_signals held;
  const pid_t child = ::fork();
  if (child < 0) throw error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child > 0) return child;
  held.release_in_child();
  ::prctl(PR_SET_PDEATHSIG, signal_of_death);
  if (::getppid() != parent) ::_exit(orphaned);  // it has died meanwhile
  become();
  ::_exit(cannot_run);
}

int file_of(const char* called, const std::string& text) {
  const int file = ::memfd_create(called, MFD_CLOEXEC);
  if (file < 0 || ::write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw error(fmt::format("cannot hand an order to a process: {}", std::strerror(errno)));
  ::lseek(file, 0, SEEK_SET);
  return file;
}

void forwarded_interrupt::look() {
  if (interrupted() && !told_) ::kill(child_, SIGTERM);
  told_ = told_ || interrupted();
}

departure departure_of(int status, double cpu_s) {
  departure end;
  end.cpu_s = cpu_s;
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.code = WEXITSTATUS(status);
  return end;
}

departure wait_for(pid_t child) {
  int status = 0;
  rusage use{};
  forwarded_interrupt interrupt(child);
  while (true) {
    interrupt.look();
    if (::wait4(child, &status, 0, &use) >= 0) return departure_of(status, cpu_time_of(use));
    if (errno != EINTR) throw error(fmt::format("cannot wait for a process: {}", std::strerror(errno)));
  }
}

}  // namespace pairsum::harness
