#pragma once
#include <sys/types.h>
#include <functional>
#include <string>

#include "harness/run/order.hpp"

namespace pairsum::harness {

/// How a child ends that is no program, and one whose parent has died.
inline constexpr int cannot_run = 127, orphaned = 126;

/// Starts a process that dies by this signal when this one does. SIGINT and SIGTERM wait meanwhile, so that none is
/// lost between fork and exec. Throws pairsum::error if the system cannot.
/// @param become called in the child; does not return
pid_t start_child(int signal_of_death, const std::function<void()>& become);

/// Sends SIGTERM to the child, once, after SIGINT or SIGTERM came.
class forwarded_interrupt {
 public:
  explicit forwarded_interrupt(pid_t child) : child_(child) {}
  void look();

 private:
  pid_t child_;
  bool told_ = false;
};

/// A file without a name that holds the text, from its beginning, for a child to read. `called`: in /proc.
/// Throws pairsum::error if the system cannot.
int file_of(const char* called, const std::string& text);

/// Waits for its end and hands interrupts on meanwhile.
departure wait_for(pid_t child);

/// What the status and use of a child that ended say.
departure departure_of(int status, double cpu_s);

}  // namespace pairsum::harness
