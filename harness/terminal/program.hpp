#pragma once
#include <functional>
#include <string>
#include <string_view>

/// What every program of pairsum does alike, whatever its work is.
namespace pairsum::harness {

/// Runs a program's work and returns its exit code: that of the work, or 2 with one line on stderr if the work throws
/// or its output is lost (a full disk). Closed descriptors 0 to 2 become /dev/null first, so that no other file takes
/// their place. A reader that closes the pipe ends the program quietly, by SIGPIPE. A file that may not grow is an
/// error of write(2), no signal. A library that calls exit() ends the program with 2, so that its code is taken for
/// none of ours.
int as_program(const char* name, const std::function<int()>& work);

/// One line on stderr that names the program. Whatever happens to it: there is nobody else to tell.
void complain(std::string_view what);

/// The text for a message: one line without control characters (`\n`, `\x1b` stand for them) or bytes that are no
/// UTF-8, long words and the whole cut.
std::string one_line(std::string_view text);

}  // namespace pairsum::harness
