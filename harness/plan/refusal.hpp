#pragma once
#include <pairsum/core/error.hpp>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace pairsum::harness {

/// The command that was called, "pairsum run".
std::string called(const CLI::App& app);

/// What a program says of words that CLI11 refuses, with the command whose --help lists the options. An option of
/// `lists`, without dashes, that is given twice is shown with one list.
error refusal(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& lists);

}  // namespace pairsum::harness
