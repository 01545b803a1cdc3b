#pragma once

namespace pairsum::harness {

/// From now on SIGINT and SIGTERM are only noted, once: a second one ends the program at once.
void note_interrupts();

/// True after such a signal.
bool interrupted();

}  // namespace pairsum::harness
