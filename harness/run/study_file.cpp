#include "harness/run/study_file.hpp"

#include <fmt/format.h>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/rows/same_build.hpp"

namespace pairsum::harness {
namespace {

/// What differs, for the message.
std::string other_build(const environment_row& there, const environment_row& here) {
  const auto say = [](const environment_row& e) {
    std::string text = fmt::format("{}, git {}{}, {}, {}, binding {}", e.host, e.git,
                                   e.dirty ? " with uncommitted changes" : "", e.compiler, e.flags, e.binding);
    for (const auto& [plugin, file] : plugins_of(e)) text += fmt::format(", {}: {}", plugin, file);
    return text;
  };
  return fmt::format("{}; this is {}", say(there), say(here));
}

}  // namespace

study_file::study_file(const std::filesystem::path& path, const study_plan& plan, const environment_row& environment)
    : path_(path), study_(plan.study), environment_(environment), lock_(path), so_far_(path, plan) {
  const rows_file& there = so_far_.rows();
  if (there.former_schema)
    throw error(fmt::format("{} holds rows of {}, this program writes {}. Name another file", path.string(),
                            former_row_schema, row_schema));
  for (const environment_row& e : there.environments)
    if (plan.builds == 1 ? !same_build(e, environment) : !same_machine(e, environment))
      throw error(fmt::format("{} holds rows of another machine or build: {}. Name another file", path.string(),
                              other_build(e, environment)));
  written_ = std::make_unique<writable_file>(path);
  lock_.take();
}

void study_file::read_on() {
  must_be_in_place();
  so_far_.read_on();
}

std::size_t study_file::mend() {
  must_be_in_place();
  return so_far_.drop_cut_line();
}

void study_file::open() {
  must_be_in_place();
  if (writer_) return;
  writer_.emplace(path_, so_far_.known());
  if (!writer_->knows(environment_.environment)) writer_->write(environment_);
}

void study_file::write(const row& r) {
  open();
  writer_->write(r);
}

void study_file::void_rounds(const std::string& why, std::optional<int> only) {
  for (const auto& [study, round] : so_far_.rows().unfinished_rounds())
    if (!only || (study == study_ && round == *only)) write(void_row{study, utc_now(), round, why});
}

}  // namespace pairsum::harness
