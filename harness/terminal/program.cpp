#include "harness/terminal/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

namespace pairsum::harness {
namespace {

const char* program = "pairsum";
bool ended = false;  ///< the work has returned or thrown

void open_closed_descriptors() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != descriptor) ::_exit(2);
}

void on_exit_call(int code, void*) {
  if (ended) return;
  complain(fmt::format("a library ended it with code {} before its work was done", code));
  ::_exit(2);
}

bool is_lost(std::FILE* stream) { return std::fflush(stream) != 0 || std::ferror(stream) != 0; }

/// Why output was lost. Where that happened too long ago for errno, one more byte meets the same fate.
std::string reason_of_loss(int number) {
  if (number == 0 && ::write(STDOUT_FILENO, "\n", 1) < 0) number = errno;
  return number != 0 ? std::strerror(number) : "it could not be written";
}

int carried_out(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    complain("out of memory; a larger dx or a smaller M needs less");
  } catch (const std::exception& e) {
    if (std::ferror(stdout) == 0) complain(e.what());
  }
  return 2;
}

/// Code points that are not seen but change what is: controls, soft hyphen, directions of writing, separators, joiners
/// of words, tags. ZWJ and ZWNJ, which scripts need, are not among them.
constexpr std::array<std::array<std::uint32_t, 2>, 9> unseen{{{0x00, 0x1F},
                                                              {0x7F, 0x9F},
                                                              {0xAD, 0xAD},
                                                              {0x61C, 0x61C},
                                                              {0x200B, 0x200B},
                                                              {0x200E, 0x200F},
                                                              {0x2028, 0x202E},
                                                              {0x2060, 0x206F},
                                                              {0xFEFF, 0xFEFF}}};
constexpr std::uint32_t tags = 0xE0000, end_of_tags = 0xE007F, end_of_unicode = 0x10FFFF;

/// How many bytes the UTF-8 character at the beginning has; 0 if there is none that can be shown.
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) { return std::uint32_t{static_cast<unsigned char>(text[k])}; };
  const std::size_t size = byte(0) < 0x80 ? 1 : byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if ((byte(0) >= 0x80 && byte(0) < 0xC2) || text.size() < size) return 0;
  std::uint32_t point = byte(0) & (size == 1 ? 0x7Fu : 0xFFu >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xC0u) != 0x80u) return 0;
    point = point << 6 | (byte(k) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};  // of so many bytes
  if (point < least[size] || point > end_of_unicode || (point >= tags && point <= end_of_tags)) return 0;
  return std::ranges::any_of(unseen, [&](const auto& r) { return point >= r[0] && point <= r[1]; }) ? 0 : size;
}

}  // namespace

void complain(std::string_view what) {
  const std::string line = fmt::format("{}: {}\n", program, one_line(what));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

int as_program(const char* name, const std::function<int()>& work) {
  open_closed_descriptors();
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);
  ::setenv("HWLOC_HIDE_ERRORS", "2", 0);  // what hwloc cannot find is null in the rows
  program = name;
  ::on_exit(on_exit_call, nullptr);
  const int code = carried_out(work);
  ended = true;
  errno = 0;
  const bool lost = is_lost(stdout);
  if (lost) complain("its output is lost: " + reason_of_loss(errno));
  return lost || is_lost(stderr) ? 2 : code;
}

std::string one_line(std::string_view text) {
  constexpr std::size_t longest_word = 300, longest = 3000;
  std::string line;
  for (std::size_t word = 0; !text.empty();) {
    if (line.size() > longest) return line + " [...]";
    const std::size_t bytes = std::max<std::size_t>(1, shown_bytes(text));
    word = text.front() == ' ' ? 0 : word + 1;
    if (word == longest_word) line += "[...]";
    if (word >= longest_word) {
      text.remove_prefix(bytes);
      continue;
    }
    if (shown_bytes(text) > 0)
      line += text.substr(0, bytes);
    else if (text.front() == '\n')
      line += "\\n";
    else
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(bytes);
  }
  return line;
}

}  // namespace pairsum::harness
