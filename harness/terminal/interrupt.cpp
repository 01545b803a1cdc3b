#include "harness/terminal/interrupt.hpp"

#include <csignal>

namespace pairsum::harness {
namespace {

volatile std::sig_atomic_t noted = 0;
void on_signal(int) { noted = 1; }

}  // namespace

void note_interrupts() {
  noted = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return noted != 0; }

}  // namespace pairsum::harness
