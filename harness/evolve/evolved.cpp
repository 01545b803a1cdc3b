#include "harness/evolve/evolved.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/environment/machine.hpp"
#include "harness/evolve/moment_file.hpp"
#include "harness/evolve/simulate_registry.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/rows/hash_text.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"

namespace pairsum::harness {
namespace {

namespace fs = std::filesystem;

/// To be raised when the recipe changes in any way.
constexpr int recipe = 1;

moment step_to(double time, const initial_condition& start, double dx, const std::string& called) {
  setup s = setup_of(start);
  s.backend = "sliced_2colour";
  s.interaction = "ferrari09_hard";
  s.grid = "compact_grid";
  s.isa = "scalar";
  s.constants.dx = dx;
  const worker_team workers(runtime::omp, untimed_threads(usable_cores()));
  simulation run(simulate_registry().make_summation(s), start, start_of(start.particles), {}, workers.get());
  progress shown(time);
  while (run.t() < time) {
    run.step(time);
    shown.show(run.t(), fmt::format("{}: t = {:.3g} s, step {}", called, run.t(), run.steps()));
    if (interrupted()) throw error("interrupted while it made " + called);
  }
  return run.save();
}

/// What is kept there, if it is whole and of these words; else it is made anew.
std::optional<saved_moment> read_if_right(const fs::path& file, const std::string& words) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    saved_moment saved = read_moment(file);
    if (saved.settings == words) return saved;
  } catch (const error&) {
  }
  return std::nullopt;
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw error(fmt::format("cannot make the folder {}: {}", folder.string(), code.message()));
}

fs::path cache_folder() {
  const auto set = [](const char* name) {
    const char* const text = std::getenv(name);
    return text != nullptr && *text != '\0' ? fs::path(text) : fs::path();
  };
  if (fs::path own = set("PAIRSUM_CACHE"); !own.empty()) return own;
  if (const fs::path users = set("XDG_CACHE_HOME"); !users.empty()) return users / "pairsum";
  if (const fs::path home = set("HOME"); !home.empty()) return home / ".cache/pairsum";
  throw error("there is no folder to keep evolved states in: set PAIRSUM_CACHE to one");
}

particles_of_request evolved(std::string_view case_name, const case_parameters& c, double time) {
  if (const std::string why = why_no_moment_files(); !why.empty()) throw error(why);
  case_parameters rest = c;
  rest.state = "rest";
  rest.H = 0;
  particles_of_request made{make_case(case_name, rest)};
  const std::string words =
      nlohmann::json{recipe, case_name, c.dim, c.dx, c.seed, time, made.initial.particles.size()}.dump();
  const std::string called = fmt::format("{} evolved to {:g} s", case_name, time);
  const fs::path file = cache_folder() / fmt::format("evolved-{}.hdf", hash_text(words));
  made.dx = c.dx;
  std::optional<saved_moment> kept = read_if_right(file, words);
  if (!kept) {
    make_folder(file.parent_path());
    write_moment(file, step_to(time, made.initial, c.dx, called), made, words);
    kept = read_moment(file);
  }
  saved_moment& saved = *kept;
  made.initial.particles = std::move(saved.what.particles);
  made.hash = saved.hash;
  if (c.H != 0) made.initial.H = c.H;
  const auto tell = [&](const char* what, std::string value, const char* from) {
    made.facts.push_back({what, std::move(value), "derived", from});
  };
  tell("state", called, "pairsum's recipe for evolved states: docs/own-particles.md");
  tell("steps", fmt::format("{}", saved.what.step), "from rest");
  tell("lost", fmt::format("{}", saved.what.lost), "fluid particles that left Omega on the way");
  return made;
}

}  // namespace pairsum::harness
