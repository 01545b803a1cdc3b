#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/launch.hpp"
#include "harness/run/worker.hpp"
#include "harness/terminal/interrupt.hpp"

namespace pairsum::harness {
namespace {

std::string read_all(int descriptor) {
  std::string text;
  char part[65536];
  for (ssize_t n = 0; (n = ::pread(descriptor, part, sizeof part, static_cast<off_t>(text.size()))) > 0;)
    text.append(part, static_cast<std::size_t>(n));
  return text;
}

std::string read_stdin() { return {std::istreambuf_iterator<char>(std::cin), {}}; }

/// @param descriptor of the order; -1: the first rank of a job reads it from stdin
int work(int descriptor) {
  const bool alone = descriptor >= 0;
  if (alone) note_interrupts();  // ranks of a job end at once, so that none waits for another
  const std::string text = alone ? read_all(descriptor) : here().told(here().is_first() ? read_stdin() : "");
  order o;
  try {
    o = parse_order(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception&) {
    throw error("worker takes the descriptor of an order from the program that conducts a study; use pairsum run");
  }
  const int code = carry_out(o, registry_of(o.plan));
  if (alone) say_done(descriptor, code);
  return code;
}

}  // namespace

void add_worker_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand("worker", "Carries out a step of a study; pairsum run starts it");
  command->group("");  // not for people
  const auto descriptor = std::make_shared<int>(-1);
  command->add_option("order", *descriptor, "file descriptor of the order")->required();
  command->callback([&chosen, descriptor] { chosen = [descriptor] { return work(*descriptor); }; });
}

}  // namespace pairsum::harness
