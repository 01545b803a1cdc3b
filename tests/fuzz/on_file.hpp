#pragma once
// What the fuzzers share: input as a file, and what an error may say.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <pairsum/core/error.hpp>
#include "harness/terminal/program.hpp"

namespace pairsum::fuzz {

/// Ends the program, so that the fuzzer keeps the input.
[[noreturn]] inline void fault(const std::string& what) {
  fmt::print(stderr, "fault: {}\n", what);
  std::abort();
}

/// A message, as programs print it, is one line of printable characters, and nobody has to scroll.
inline void check_message(const std::string& what) {
  constexpr std::size_t most = 3100;
  const std::string text = harness::one_line(what);
  if (text.empty() || text.size() > most) fault(fmt::format("a message of {} bytes", text.size()));
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) fault("a message with a control character: " + text);
}

/// Calls read(path) with the input as a file; only pairsum::error may come out of it, with one good line. Returns
/// whether none did.
template <class Read>
bool on_file(const std::uint8_t* data, std::size_t size, Read read) {
  const int file = memfd_create("input", MFD_CLOEXEC);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  const std::string path = fmt::format("/proc/self/fd/{}", file);
  bool good = true;
  try {
    read(path);
  } catch (const error& e) {
    check_message(e.what());
    good = false;
  }
  close(file);
  return good;
}

}  // namespace pairsum::fuzz
