#include "harness/run/runner.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>

#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/measure/memory.hpp"
#include "harness/rows/writer.hpp"
#include "harness/run/interrupt.hpp"
#include "harness/run/progress.hpp"
#include "harness/run/results_table.hpp"
#include "harness/run/world.hpp"

namespace pairsum::harness {
namespace {

std::string label(const point& p) {
  return fmt::format("{} dx={} {} M={} threads={}", p.backend, p.dx, p.state, p.M, p.threads);
}

std::string full_label(const point& p) { return fmt::format("{} ({})", label(p), words_of(p)); }

std::string place(const point& p) {
  return fmt::format("dx={} {} {} {} {}", p.dx, p.state, p.precision, p.interaction, p.smoothing);
}

/// One invocation: a round of the rows file.
class round_run {
 public:
  round_run(const registry& all, const run_request& r, const std::filesystem::path& out)
      : registry_(all), request_(r), round_(last_round(out) + 1), environment_(describe_environment(r.study)) {
    std::map<std::pair<double, std::string>, std::shared_ptr<const world_particles>> particles;
    for (const world_plan& w : expand(r, all)) {
      auto& shared = particles[{w.front().dx, w.front().state}];
      if (!shared) shared = std::make_shared<world_particles>(request_, w.front());
      plans_.push_back({w, std::make_unique<world>(registry_, request_, w.front(), shared)});
    }
    writer_ = std::make_unique<row_writer>(out);  // last, so that bad input leaves no file behind
    writer_->write(environment_);
    std::size_t points = 0;
    for (const auto& p : plans_) points += p.plan.size();
    progress_ = std::make_unique<progress>(static_cast<double>(points) * (request_.repetitions + warm_up_cost),
                                           request_.budget_s);
  }

  int run() {
    for (auto& p : plans_) prepare(p);
    const double warm_up_s = since_start_.seconds();
    for (int repetition = 1; repetition <= request_.repetitions && !interrupted(); ++repetition) {
      stopwatch one;
      for (auto& p : plans_) measure(p, repetition);
      last_repetition_s_ = one.seconds();
      if (request_.budget_s > 0 && since_start_.seconds() + last_repetition_s_ > request_.budget_s &&
          repetition < request_.repetitions) {
        progress_->clear();
        fmt::print(
            "budget of {:.0f} s: {} of {} repetitions made (warm-up and verification {:.0f} s, a repetition {:.0f} "
            "s)\n",
            request_.budget_s, repetition, request_.repetitions, warm_up_s, last_repetition_s_);
        break;
      }
    }
    progress_->clear();
    fmt::print("{}", results_table(samples_));
    if (interrupted()) return 130;
    return failed_ ? 1 : 0;
  }

 private:
  static constexpr double warm_up_cost = 2;  ///< a verified warm-up takes about this many repetitions

  struct planned {
    world_plan plan;
    std::unique_ptr<world> made;
    bool ready = false;
  };

  void advance(double units, const std::string& what) {
    done_ += units;
    progress_->show(done_, what);
  }

  /// Makes the world and warms every point up, verified; points that fail are reported and not measured.
  void prepare(planned& p) {
    if (interrupted()) return;
    progress_->show(done_, "reference for " + place(p.plan.front()));
    p.made->make_reference();
    p.ready = true;
    if (p.made->dropped() > 0)
      note(fmt::format("{} particles outside Omega were dropped ({})", p.made->dropped(), place(p.plan.front())));
    std::vector<point> good;
    for (point& q : p.plan) {
      if (interrupted()) return;
      p.made->complete(q);
      progress_->show(done_, "warm-up " + label(q));
      const world::result r = p.made->measure(q);
      if (r.interrupted) return;
      if (r.error.empty())
        good.push_back(q);
      else
        write_failure(q, r.error);
      if (r.lost > 0) note(fmt::format("{}: {} particles left Omega and are no longer summed", full_label(q), r.lost));
      advance(warm_up_cost + (r.error.empty() ? 0 : request_.repetitions), label(q));
    }
    p.plan = std::move(good);
  }

  void measure(planned& p, int repetition) {
    if (!p.ready) return;
    const auto order = shuffled_order(p.plan.size(), request_.seed, repetition);
    for (std::size_t slot = 0; slot < order.size() && !interrupted(); ++slot) {
      const point& q = p.plan[order[slot]];
      const world::result r = p.made->measure(q);
      if (r.interrupted) return;
      if (!r.error.empty()) {
        write_failure(q, r.error);
      } else {
        for (std::size_t k = 0; k < r.steps.size(); ++k) write_step(q, r, k, static_cast<int>(slot) + 1, repetition);
      }
      advance(1, label(q));
    }
  }

  sample blank(const point& q) const {
    sample s;
    s.study = request_.study;
    s.round = round_;
    s.seed = request_.seed;
    s.utc = utc_now();
    s.environment = environment_.environment;
    s.point = q;
    return s;
  }

  void write_step(const point& q, const world::result& r, std::size_t k, int slot, int repetition) {
    const step_result& step = r.steps[k];
    sample s = blank(q);
    s.slot = slot;
    s.repetition = repetition;
    s.step = static_cast<int>(k) + 1;
    s.phases = step.times;
    if (k == 0) s.work = r.work;
    s.peak_rss_bytes = r.peak_rss_bytes;
    s.verify = {step.checked.max_rel_err, step.checked.bound, fmt::format("{:016x}", step.checked.fingerprint)};
    keep(s);
  }

  void write_failure(const point& q, const std::string& why) {
    failed_ = true;
    sample s = blank(q);
    s.error = why;
    keep(s);
    note(fmt::format("{} FAILED its verification: {}", full_label(q), why));
  }

  void keep(const sample& s) {
    writer_->write(s);
    samples_.push_back(s);
  }

  void note(const std::string& line) {
    progress_->clear();
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  const registry& registry_;
  run_request request_;
  int round_;
  std::unique_ptr<row_writer> writer_;
  environment_row environment_;
  std::vector<planned> plans_;
  std::vector<sample> samples_;
  std::unique_ptr<progress> progress_;
  stopwatch since_start_;
  double done_ = 0, last_repetition_s_ = 0;
  bool failed_ = false;
};

}  // namespace

std::filesystem::path default_rows_path(const std::filesystem::path& results, const std::string& study) {
  const environment_row e = describe_environment(study);
  return results / study / fmt::format("{}-{}-{}.jsonl", e.host, utc_stamp(), e.git + (e.dirty ? "-dirty" : ""));
}

int run(const run_request& r, const std::filesystem::path& out, const registry& all) {
  check_request(r, all);
  keep_freed_memory();
  note_interrupts();
  round_run s(all, r, out);
  const int cores = usable_cores();
  for (const int t : r.threads)
    if (t > cores) fmt::print("note: {} threads on {} cores\n", t, cores);
  return s.run();
}

}  // namespace pairsum::harness
