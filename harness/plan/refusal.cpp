#include "harness/plan/refusal.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

namespace pairsum::harness {
namespace {

/// The options of the command that was called.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return (commands.empty() ? &app : commands.front())->get_options();
}

/// How CLI11 begins what it says of a word that is no number.
constexpr std::string_view unconverted = "Could not convert: ";

std::string reason(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& lists) {
  for (const CLI::Option* o : options_of(app))
    if (o->get_items_expected_max() == 1 && o->results().size() > 1 && !o->get_positional())
      return fmt::format("{} is given {} times, should be once", o->get_name(), o->results().size()) +
             (std::ranges::find(lists, o->get_single_name()) != lists.end()
                  ? fmt::format("; a list has commas: {} {}", o->get_name(), fmt::join(o->results(), ","))
                  : "");
  const std::string text = e.what();
  const std::size_t equals = text.find(" = ");
  if (!text.starts_with(unconverted) || equals == text.npos) return text;
  return fmt::format("{} takes a number, not \"{}\"", text.substr(unconverted.size(), equals - unconverted.size()),
                     text.substr(equals + 3));
}

}  // namespace

std::string called(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app.get_name() : app.get_name() + " " + commands.front()->get_name();
}

error refusal(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& lists) {
  return error(fmt::format("{} (see {} --help)", reason(app, e, lists), called(app)));
}

}  // namespace pairsum::harness
