#include "harness/evolve/particles_of_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/plan/levels.hpp"
#include "harness/plan/words.hpp"
#include "harness/terminal/program.hpp"
#if PAIRSUM_HAS_FILES
#include <pairsum/files/read_particles.hpp>
#endif

namespace pairsum::harness {
#if PAIRSUM_HAS_FILES
namespace {

double number(const std::string& option, const std::string& text) {
  const std::vector<double> one = parse_numbers(option, text);
  if (one.size() != 1) throw error(fmt::format("{} takes one number, not \"{}\"", option, text));
  return one.front();
}

int dimension(const std::string& text) {
  check_word("dimension", text, std::vector<std::string_view>{"1", "2", "3"});
  return text[0] - '0';
}

/// What a column may be.
const std::vector<std::string_view> quantities{"x", "y", "z", "vx", "vy", "vz", "rho", "m", "h", "kind"};

files::hints hints_of(const run_request& r) {
  files::hints told;
  if (r.H != 0) told.H = r.H;
  if (r.H_in_spacings != 0) told.H_in_spacings = r.H_in_spacings;
  for (const auto& [word, text] : r.hints) {
    const std::string option = option_of(word);
    const std::pair<const char*, std::optional<double> files::hints::*> numbers[] = {
        {"h", &files::hints::h},       {"support", &files::hints::support}, {"h_quantile", &files::hints::h_quantile},
        {"rho0", &files::hints::rho0}, {"mass", &files::hints::mass},       {"B", &files::hints::B}};
    const auto at = std::ranges::find(numbers, word, [](const auto& n) { return n.first; });
    if (at != std::end(numbers))
      told.*at->second = number(option, text);
    else if (word == "boundary_kind")
      told.boundary_kind = text;
    else if (word == "periodic")
      told.periodic = text;
    else if (word == "box")
      told.box = parse_row(option, text);
    else if (word == "file_dim")
      told.dim = dimension(text);
    else if (word == "file_step")
      told.step = static_cast<std::int64_t>(number(option, text));
    else
      for (const std::string& one : parse_words(option, text)) {
        const std::size_t equals = one.find('=');
        if (equals == one.npos || equals == 0 || equals + 1 == one.size())
          throw error(fmt::format("{} takes QUANTITY=COLUMN, like x=Points:0, not \"{}\"", option, one));
        check_word("quantity of --column", one.substr(0, equals), quantities);
        told.columns[one.substr(0, equals)] = one.substr(equals + 1);
      }
  }
  return told;
}

particles_of_request read(const run_request& r) {
  files::read_set set = files::read_particles(r.particles, hints_of(r));
  particles_of_request made{std::move(set.initial), set.dx, set.hash, r.particles, {}};
  for (const files::fact& f : set.facts)
    made.facts.push_back({one_line(f.what), one_line(f.value), std::string(files::word_of(f.how)), one_line(f.from)});
  if (r.H != 0) made.facts.push_back({"--H", number_text(r.H), "given", ""});
  for (const auto& [word, text] : r.hints)
    made.facts.push_back({word == "file_dim" ? "--dim" : option_of(word), text, "given", ""});
  return made;
}

}  // namespace

particles_of_request particles_of_files(const run_request& r) {
  static std::optional<std::pair<std::string, particles_of_request>> last;
  const std::string key = nlohmann::json{r.particles, r.hints, r.H, r.H_in_spacings}.dump();
  if (!last || last->first != key) last.emplace(key, read(r));
  return last->second;
}

#else

particles_of_request particles_of_files(const run_request&) {
  throw error("this build reads no particle files: it was made without PAIRSUM_FILES");
}

#endif

std::string table_of(const particles_of_request& read) {
  std::size_t what = 0, value = 0, how = 0;
  for (const auto& fact : read.facts) {
    if (fact[0].starts_with("--")) continue;  // an option as it was given; what it did stands there, too
    what = std::max(what, fact[0].size());
    value = std::max(value, fact[1].size());
    how = std::max(how, fact[2].size());
  }
  std::string text;
  for (const auto& fact : read.facts)
    if (!fact[0].starts_with("--"))
      text += fmt::format("  {:<{}}  {:<{}}  {:<{}}  {}\n", fact[0], what, fact[1], value, fact[2], how, fact[3]);
  return text;
}

}  // namespace pairsum::harness
