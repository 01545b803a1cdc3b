#include "harness/simulate/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <pairsum/core/error.hpp>
#include <pairsum/core/granularity.hpp>
#include "harness/evolve/balance.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/evolve/moment_file.hpp"
#include "harness/evolve/simulate_registry.hpp"
#include "harness/measure/binding.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/plan/levels.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/simulate/log.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"

namespace pairsum::harness {
namespace {

namespace fs = std::filesystem;

void check_time(const char* what, double s) {
  if (!(s > 0) || !std::isfinite(s)) throw error(fmt::format("{} must be a positive time in s, is {}", what, s));
}

/// Every `period` s, counted from 0; never without one.
class every {
 public:
  explicit every(double period, double from) : period_(period) {
    if (period > 0) count_ = static_cast<std::uint64_t>(std::floor(from / period * (1 + 1e-12))) + 1;
  }
  double next() const { return period_ > 0 ? period_ * static_cast<double>(count_) : HUGE_VAL; }
  bool due(double t) const { return t >= next() * (1 - 1e-12); }
  void pass(double t) {
    while (due(t)) ++count_;
  }

 private:
  double period_;
  std::uint64_t count_ = 1;
};

simulate_request complete(simulate_request r) {
  check_time("--until", r.until);
  if (r.every == 0) r.every = r.until / 20;
  if (r.log == 0) r.log = r.until / 200;
  check_time("--every", r.every);
  check_time("--log", r.log);
  if (r.checkpoint != 0) check_time("--checkpoint", r.checkpoint);
  if (r.checkpoint != 0 && r.snapshots.empty()) throw error("--checkpoint needs a folder to write to: --snapshots DIR");
  if (r.rules.dt != 0) check_time("--dt", r.rules.dt);
  if (!(r.rules.cfl > 0 && r.rules.cfl <= 1))
    throw error(fmt::format("--cfl must lie between 0 and 1, is {}", r.rules.cfl));
  if (const std::string why = why_no_moment_files(); !r.snapshots.empty() && !why.empty()) throw error(why);
  r.rules.drop = r.levels.outside == "drop";
  r.rules.integrator = r.levels.integrators.front();
  return r;
}

/// The one point that the levels make.
point only_point(const run_request& r, const registry& all) {
  check_request(r, all);
  const nlohmann::json levels = levels_json(r);
  for (const auto& [key, value] : levels.items())
    if (value.is_array() && value.size() > 1)
      throw error(fmt::format("simulate takes one of each, but --{} names {}", key, value.size()));
  const std::vector<world_plan> worlds = expand(r, all);
  if (worlds.empty()) throw error("this build has no backend for these words");
  return worlds.front().front();
}

/// What decides the bits of every moment. How long it goes on does not.
std::string settings_of(const simulate_request& r, const std::string& particles) {
  nlohmann::json j = levels_json(r.levels);
  for (const char* const key : {"repetitions", "steps", "dt", "order", "granularity", "threads"}) j.erase(key);
  j["dt"] = r.rules.dt;
  j["cfl"] = r.rules.cfl;
  j["every"] = r.every;
  j["checkpoint"] = r.checkpoint;
  j["particles"] = particles;
  return j.dump();
}

/// Throws the error for a folder whose simulation had other settings.
void check_settings(const fs::path& folder, const std::string& there, const std::string& here) {
  if (there == here) return;
  const nlohmann::json was = nlohmann::json::parse(there, nullptr, false), is = nlohmann::json::parse(here);
  for (const auto& [key, value] : is.items())
    if (!was.is_object() || was.value(key, nlohmann::json()) != value)
      throw error(fmt::format(
          "{} holds a simulation with {} {}, now it is {}; --fresh starts over there, or name another folder",
          folder.string(), key, was.is_object() ? was.value(key, nlohmann::json()).dump() : "unknown", value.dump()));
  throw error(fmt::format("{} holds another simulation; --fresh starts over there", folder.string()));
}

fs::path snapshot_file(const fs::path& folder, double t, double period) {
  return folder / fmt::format("snapshot_{:04}.hdf", std::lround(t / period));
}

std::vector<fs::path> snapshots_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("snapshot_") && name.ends_with(".hdf"))
      found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

}  // namespace

simulate_result simulate(const simulate_request& asked, const moment_reader& at) {
  const simulate_request r = complete(asked);
  const registry& all = simulate_registry();
  simulate_result result;
  result.what = only_point(r.levels, all);
  const particles_of_request start = initial_of(r.levels, r.levels.dx.front(), r.levels.states.front());
  const initial_condition& domain = start.initial;
  const std::string settings = settings_of(r, start.hash);
  const bool keeps = !r.snapshots.empty();
  const fs::path checkpoint = r.snapshots / "checkpoint.hdf";
  moment from{domain.particles, {}, 0, 0, 0, 0};
  for (std::size_t i = 0; i < from.particles.size(); ++i) from.ids.push_back(static_cast<std::uint32_t>(i));
  if (keeps) fs::create_directories(r.snapshots);
  if (keeps && !r.fresh && fs::exists(checkpoint)) {
    saved_moment saved = read_moment(checkpoint);
    check_settings(r.snapshots, saved.settings, settings);
    from = std::move(saved.what);
    result.resumed_from = from.t;
  }
  std::optional<simulation_log> log;
  if (keeps) log.emplace(r.snapshots / "log.csv", from.step);

  const thread_binding binding(r.binding);
  const point& p = result.what;
  auto sum = all.make_summation(setup_of_point(p, domain));
  const runtime kind = sum->traits().threads;
  const worker_team workers(kind, p.threads, &binding);
  const team t = workers.get().with(parse_granularity(p.granularity, kind));
  const std::uint64_t first_step = from.step;
  every snapshots(r.every, from.t), checkpoints(r.checkpoint, from.t), logs(r.log, from.t);
  simulation run(std::move(sum), domain, std::move(from), r.rules, t);
  progress shown(r.until);

  const auto record = [&](const moment& m) {
    if (log) log->write(m, balance_of(m.particles, domain.gravity, domain.eos));
  };
  /// A checkpoint comes last: what it goes on from is all there.
  const auto keep = [&](const moment& m, bool snapshot, bool ends) {
    shown.clear();
    if (snapshot || ends) at(m, domain);
    if (!keeps) return;
    log->flush();
    if (snapshot) {
      write_moment(snapshot_file(r.snapshots, m.t, r.every), m, domain, settings);
      write_series(r.snapshots / "snapshots.xmf", snapshots_in(r.snapshots));
    }
    write_moment(checkpoint, m, domain, settings);
  };
  if (first_step == 0) {
    const moment m = run.save();
    record(m);
    keep(m, true, false);
  }
  note_interrupts();
  stopwatch clock;
  double stepping = 0;
  while (run.t() < r.until && !result.interrupted) {
    clock.lap();
    run.step(std::min({r.until, snapshots.next(), checkpoints.next()}));
    stepping += clock.lap();
    const bool snapshot = snapshots.due(run.t()), ends = run.t() >= r.until;
    if (snapshot || checkpoints.due(run.t()) || ends) {
      const moment m = run.save();
      record(m);
      keep(m, snapshot, ends);
      logs.pass(run.t());
    } else if (logs.due(run.t())) {
      record(run.look());
      logs.pass(run.t());
    }
    snapshots.pass(run.t());
    checkpoints.pass(run.t());
    shown.show(run.t(),
               fmt::format("t = {:.4g} of {:g} s, step {}, {} lost", run.t(), r.until, run.steps(), run.lost()));
    result.interrupted = interrupted();
  }
  shown.clear();
  result.seconds = stepping;
  result.steps = run.steps() - first_step;
  result.end = run.look();
  return result;
}

}  // namespace pairsum::harness
