#include "harness/simulate/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <pairsum/core/error.hpp>
#include <pairsum/core/granularity.hpp>
#include "harness/evolve/balance.hpp"
#include "harness/evolve/evolved.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/evolve/moment_file.hpp"
#include "harness/evolve/simulate_registry.hpp"
#include "harness/measure/binding.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/plan/levels.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/run/seats.hpp"
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
  if (r.levels.ranks == std::vector<int>{1}) {  // as in folders that know no ranks
    j.erase("ranks");
    j.erase("cut");
  }
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

/// Is it a name of snapshot_file()?
bool is_snapshot(const std::string& name) {
  constexpr std::string_view begin = "snapshot_", end = ".hdf";
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() <= begin.size() + end.size()) return false;
  return std::all_of(name.begin() + begin.size(), name.end() - end.size(), [](char c) { return c >= '0' && c <= '9'; });
}

/// What a simulation keeps in its folder.
struct kept_files {
  fs::path folder, checkpoint = folder / "checkpoint.hdf", log = folder / "log.csv", series = folder / "snapshots.xmf";

  std::vector<fs::path> snapshots() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_snapshot(entry.path().filename().string())) found.push_back(entry.path());
    return found;
  }
  /// Of another simulation, which --fresh gives up.
  void remove() const {
    for (const fs::path& file : snapshots()) fs::remove(file);
    for (const fs::path& file : {checkpoint, log, series}) fs::remove(file);
  }
  /// Throws if something is there, and no checkpoint that says what.
  void check_free() const {
    if (fs::exists(log) || fs::exists(series) || !snapshots().empty())
      throw error(
          fmt::format("{} has files with the names of a simulation, but no checkpoint; name another folder, or "
                      "--fresh, which removes them",
                      folder.string()));
  }
};

/// What the user did not say goes on as it was.
void take_over(simulate_request& r, const std::string& settings) {
  const nlohmann::json was = nlohmann::json::parse(settings, nullptr, false);
  if (!was.is_object()) return;
  if (r.every == 0) r.every = was.value("every", 0.0);
  if (r.checkpoint == 0) r.checkpoint = was.value("checkpoint", 0.0);
}

}  // namespace

simulate_result simulate(const simulate_request& asked, const moment_reader& at) {
  const bool keeps = !asked.snapshots.empty();
  if (const std::string why = why_no_moment_files(); keeps && !why.empty()) throw error(why);
  const kept_files files{asked.snapshots};
  const crew& all_ranks = here();
  if (asked.levels.ranks != std::vector<int>{all_ranks.size()})
    throw error(fmt::format("this process is one of {} ranks, and {} are asked for", all_ranks.size(),
                            fmt::join(asked.levels.ranks, ",")));
  const bool writes = keeps && all_ranks.is_first();
  std::optional<saved_moment> saved;
  const bool goes_on = keeps && !asked.fresh && fs::exists(files.checkpoint);
  if (!all_ranks.told(goes_on ? "it goes on" : "").empty()) saved = read_moment(files.checkpoint);
  simulate_request r = asked;
  if (saved) take_over(r, saved->settings);
  r = complete(r);
  const registry& all = simulate_registry();
  simulate_result result;
  result.what = only_point(r.levels, all);
  particles_of_request start;
  all_ranks.in_turn([&] { start = initial_of(r.levels, r.levels.dx.front(), r.levels.states.front()); });
  const initial_condition& domain = start.initial;
  const std::string settings = settings_of(r, start.hash);
  moment from = start_of(domain.particles);
  if (saved) {
    check_settings(files.folder, saved->settings, settings);
    from = std::move(saved->what);
    result.resumed_from = from.t;
  } else if (writes) {  // the request has proved right
    make_folder(files.folder);
    asked.fresh ? files.remove() : files.check_free();
    write_moment(files.checkpoint, from, start, settings);  // from now on the folder says whose it is
  }
  std::optional<simulation_log> log;
  if (writes) log.emplace(files.log, from.step);
  std::vector<moment_in_series> series;
  if (writes)
    for (const fs::path& file : files.snapshots())
      if (moment_in_series one = series_entry(file); one.t < from.t) series.push_back(std::move(one));
  std::ranges::sort(series, {}, &moment_in_series::t);

  const thread_binding binding(r.binding);
  const point& p = result.what;
  auto sum = all_ranks.share(all.make_summation(setup_of_point(p, domain)), p.cut);
  const runtime kind = sum->traits().threads;
  const std::size_t first_unit = place(seats_of(binding), p.threads).first[static_cast<std::size_t>(all_ranks.rank())];
  const worker_team workers(kind, p.threads, &binding, static_cast<int>(first_unit));
  const team t = workers.get().with(parse_granularity(p.granularity, kind));
  const std::uint64_t first_step = from.step;
  every snapshots(r.every, from.t), checkpoints(r.checkpoint, from.t), logs(r.log, from.t);
  simulation run(std::move(sum), domain, std::move(from), r.rules, t, all_ranks);
  progress shown(r.until);

  const auto balance_at = [&](const moment& m) { return balance_of(m.particles, domain.gravity, domain.eos); };
  const auto record = [&](const moment& m) {
    if (log) log->write(m, run.last_dt(), balance_at(m));
  };
  std::optional<double> start_energy = log ? log->first_energy() : std::nullopt;
  /// A checkpoint comes last: what it goes on from is all there.
  const auto keep = [&](const moment& m, bool snapshot, bool ends) {
    shown.clear();
    const balance b = balance_at(m);
    if (!start_energy) start_energy = b.energy();
    if (snapshot || ends) at(m, b, *start_energy);
    if (!writes) return;
    log->flush();
    if (snapshot) {
      series.push_back({snapshot_file(files.folder, m.t, r.every), m.t, m.particles.size()});
      write_moment(series.back().file, m, start, settings);
      write_series(files.series, series);
    }
    write_moment(files.checkpoint, m, start, settings);
  };
  if (first_step == 0) {
    const moment m = run.save();
    record(m);
    keep(m, true, false);
  }
  if (all_ranks.size() == 1) note_interrupts();  // ranks of a job end at once, so that none waits for another
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
