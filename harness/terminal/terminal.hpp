#pragma once
#include <cstdio>
#include <string>
#include <string_view>

/// What is known of the terminal that a stream is shown on.
namespace pairsum::harness {

bool is_terminal(std::FILE* stream);

/// The width of the stream's terminal in columns, asked anew each time, since a window may be resized; where it does
/// not tell, and for files and pipes, 80.
int columns_of(std::FILE* stream);

/// What a text in colour says: an emphasis, or a verdict.
enum class tone { strong, good, doubtful, bad };

/// Shall the stream have colours? Only if it is a terminal, other than TERM=dumb, and NO_COLOR is not set to anything
/// (https://no-color.org).
bool has_colours(std::FILE* stream);

/// The text in bold (strong), green (good), yellow (doubtful) or red (bad) if `colours`, else as it is.
std::string coloured(tone how, std::string_view text, bool colours = has_colours(stdout));

/// How many columns a UTF-8 text takes whose characters are one wide each.
std::size_t columns_in(std::string_view text);

/// The first `columns` characters of a UTF-8 text.
std::string_view cut_to(std::string_view text, std::size_t columns);

}  // namespace pairsum::harness
