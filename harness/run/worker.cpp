#include "harness/run/worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/measure/memory.hpp"
#include "harness/measure/worker_team.hpp"
#include "harness/model/peaks.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/rows/reader.hpp"
#include "harness/rows/writer.hpp"
#include "harness/run/describe_backend.hpp"
#include "harness/run/ranking.hpp"
#include "harness/run/seats.hpp"
#include "harness/run/world.hpp"
#include "harness/self_test/self_test.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/program.hpp"
#include "harness/terminal/progress.hpp"

namespace pairsum::harness {
namespace {

std::uint64_t largest_cache(const environment_row& e) {
  std::uint64_t largest = 0;
  for (const auto& [level, bytes] : e.caches) largest = std::max(largest, bytes);
  return largest;
}

std::string label(const point& p) { return fmt::format("{} {} {}", place_words(p), p.isa, p.precision); }
/// The same with the problem, for lines that stay.
std::string whole_label(const point& p) { return fmt::format("{} ({})", label(p), problem_words(p)); }

/// A part's points with the worlds they live in.
class measured_part {
 public:
  measured_part(const order& o, const measuring& with) : request_(o.plan.parts[o.part].request) {
    std::map<std::pair<double, std::string>, std::shared_ptr<const world_particles>> particles;
    for (world_plan points : expand(request_, with.all)) {
      std::erase_if(points, [&](const point& p) { return p.ranks != o.ranks; });
      if (points.empty()) continue;
      auto& shared = particles[{points.front().dx, points.front().state}];
      if (!shared) shared = std::make_shared<world_particles>(request_, points.front());
      worlds_.push_back(std::make_unique<world>(with, request_, points.front(), shared));
      for (point p : points) {
        worlds_.back()->complete(p);
        points_.push_back({p, worlds_.size() - 1});
      }
    }
  }

  struct place_of {
    point what;
    std::size_t where;
  };

  const run_request& request() const { return request_; }
  const std::vector<place_of>& points() const { return points_; }
  std::vector<std::unique_ptr<world>>& worlds() { return worlds_; }
  world& world_of(const place_of& p) { return *worlds_[p.where]; }

 private:
  run_request request_;
  std::vector<std::unique_ptr<world>> worlds_;
  std::vector<place_of> points_;
};

/// The store of references and verdicts. Ranks do not inherit it: the first opens it anew where it runs on the host of
/// the process that has it.
std::unique_ptr<shared_store> store_of(const order& o) {
  if (o.ranks == 1) return o.store >= 0 ? std::make_unique<shared_store>(o.store) : nullptr;
  if (!here().is_first() || o.store_host != describe_machine().host) return nullptr;
  return shared_store::open(o.store_path);
}

/// One order under way.
class errand_run {
 public:
  errand_run(const order& o, const registry& all)
      : order_(o),
        binding_(o.binding),
        environment_(describe_environment(o.plan.study, binding_.description(), hardware_.description())),
        store_(store_of(o)),
        with_{all,
              binding_,
              hardware_,
              store_.get(),
              environment_.environment,
              largest_cache(environment_),
              seats_of(binding_)},
        progress_(o.where, o.plan.budget_s) {}

  int verify() {
    measured_part part(order_, with_);
    const double unit = 1.0 / static_cast<double>(part.points().size() + 2 * part.worlds().size());
    for (const auto& w : part.worlds()) {
      if (interrupted()) return 130;
      show("making the reference");
      w->make_reference();
      advance(2 * unit);
      if (w->dropped() > 0) note(fmt::format("{} particles outside Omega were dropped", w->dropped()));
    }
    for (const auto& p : part.points()) {
      if (interrupted()) return 130;
      show("verifying " + label(p.what));
      const world::result r = part.world_of(p).measure(p.what);
      if (r.interrupted) return 130;
      if (!r.error.empty())
        note(fmt::format("{} {}: {}", whole_label(p.what), r.bad_state ? "gets no time" : "FAILED its verification",
                         r.error));
      if (!r.untimed.empty() && r.error.empty())
        note(fmt::format("{} gets no times: {}", whole_label(p.what), r.untimed));
      std::uint64_t lost = 0;
      for (const step_result& step : r.steps) lost += step.lost;
      if (lost > 0 && r.error.empty())
        note(fmt::format("{}: {} particles left Omega and are no longer summed", whole_label(p.what), lost));
      advance(unit);
    }
    for (const auto& w : part.worlds()) w->remember();
    return 0;
  }

  int measure() {
    measured_part part(order_, with_);
    for (const auto& w : part.worlds()) w->make_reference();
    open();
    describe_particles(part);
    describe_backends(part);
    warm_up(part);
    const int repetitions = part.request().repetitions;
    const auto machine = paces_of(part);
    const std::size_t entries = part.points().size() + machine.size();
    const double unit = 1.0 / static_cast<double>(entries * static_cast<std::size_t>(repetitions));
    for (int repetition = 1; repetition <= repetitions; ++repetition) {
      const auto sequence = shuffled_order(entries, part.request().seed, order_.round, repetition);
      for (std::size_t slot = 0; slot < sequence.size(); ++slot) {
        if (interrupted()) return 130;
        if (sequence[slot] >= part.points().size()) {
          write_pace(machine[sequence[slot] - part.points().size()]);
          advance(unit);
          continue;
        }
        const auto& p = part.points()[sequence[slot]];
        const world::result r = part.world_of(p).measure(p.what);
        if (r.interrupted) return 130;
        write(p.what, r, static_cast<int>(slot) + 1, repetition);
        advance(unit);
        show(last_);
      }
    }
    for (const auto& w : part.worlds()) w->remember();  // verdicts on bits that were new
    return failed_ ? 1 : 0;
  }

  /// The line on the terminal stays, for the next process.
  void hand_over() { progress_.hand_over(); }

  int peaks() {
    auto wanted = peaks_of(order_.plan, with_.all);
    open();
    for (const peak_row& p : read_rows(order_.out).peaks)  // by a process that was cut
      if (p.study == order_.plan.study && p.environment == environment_.environment)
        wanted.erase({p.threads, p.precision});
    for (const auto& [threads, precision] : wanted) {
      if (interrupted()) return 130;
      show(fmt::format("measuring the peaks of {} threads, {}", threads, precision));
      const worker_team workers(runtime::omp, threads, &binding_);
      const peak_rates rates =
          measure_peaks(precision, workers.get(), {.last_level_cache_bytes = with_.last_level_cache_bytes});
      writer_->write(peak_row{order_.plan.study, utc_now(), environment_.environment, threads, precision,
                              rates.bandwidth_bytes_per_s, rates.flops_per_s});
      advance(1.0 / static_cast<double>(wanted.size()));
    }
    return 0;
  }

 private:
  using threads_and_precision = std::pair<int, std::string>;

  /// What of the machine is measured among the part's points, so that their speedups, and times of another day, can be
  /// set against it: if the plan wants peaks, the multiply-adds of every number of threads and precision.
  std::vector<threads_and_precision> paces_of(const measured_part& part) const {
    std::set<threads_and_precision> wanted;
    if (order_.plan.peaks && order_.ranks == 1)
      for (const auto& p : part.points()) wanted.emplace(p.what.threads, p.what.precision);
    return {wanted.begin(), wanted.end()};
  }

  void write_pace(const threads_and_precision& of) {
    constexpr double budget_s = 0.1;
    const worker_team workers(runtime::omp, of.first, &binding_);
    const double flops = measure_multiply_adds(of.second, workers.get(), budget_s);
    writer_->write(
        pace_row{order_.plan.study, utc_now(), environment_.environment, order_.round, of.first, of.second, flops});
  }

  /// One step of every backend with the most threads it gets, in every world: pages, pools and clocks are awake after
  /// it, and nothing of it is kept.
  void warm_up(measured_part& part) {
    show("warming up");
    std::map<std::pair<std::size_t, std::string>, const measured_part::place_of*> most;
    for (const auto& p : part.points()) {
      auto& at = most[{p.where, p.what.backend}];
      if (at == nullptr || at->what.threads < p.what.threads) at = &p;
    }
    for (const auto& [key, p] : most)
      if (!interrupted()) part.world_of(*p).measure(p->what, 1);
  }

  /// The rows file, once the input has proved right; with the environment row if it is not there.
  void open() {
    if (!here().is_first()) return;
    writer_ = std::make_unique<row_writer>(order_.out, order_.known);
    if (!writer_->knows(environment_.environment)) writer_->write(environment_);
  }

  /// A row for the particles of every world that no case makes, if there is none.
  void describe_particles(measured_part& part) {
    if (!here().is_first()) return;
    for (const auto& w : part.worlds()) {
      const particles_of_request& made = w->particles();
      if (made.hash.empty() || writer_->knows_particles(made.hash)) continue;
      writer_->write(particles_row{order_.plan.study, utc_now(), made.hash, made.files, made.facts});
    }
  }

  /// A row for every backend of the part that has none there.
  void describe_backends(const measured_part& part) {
    if (!here().is_first()) return;
    for (const auto& p : part.points()) {
      if (writer_->knows(environment_.environment, p.what.backend)) continue;
      backend_row b = describe_backend(with_.all.find_backend(p.what.backend).traits);
      b.study = order_.plan.study;
      b.utc = utc_now();
      b.environment = environment_.environment;
      writer_->write(b);
    }
  }

  sample blank(const point& p, int slot, int repetition) const {
    sample s;
    s.study = order_.plan.study;
    s.part = order_.plan.parts[order_.part].request.part;
    s.round = order_.round;
    s.slot = slot;
    s.repetition = repetition;
    s.seed = order_.plan.parts[order_.part].request.seed;
    s.utc = utc_now();
    s.environment = environment_.environment;
    s.point = p;
    return s;
  }

  void write(const point& p, const world::result& r, int slot, int repetition) {
    if (!r.error.empty()) failed_ = failed_ || !must_fail(order_.plan, p.backend);
    if (!here().is_first()) return;
    sample s = blank(p, slot, repetition);
    if (!r.error.empty()) {  // a backend that is wrong gets no time
      s.error = one_line(r.error);
      writer_->write(s);
      return;
    }
    double sum = 0;
    for (std::size_t k = 0; k < r.steps.size(); ++k) {
      const step_result& step = r.steps[k];
      s.step = static_cast<int>(k) + 1;
      if (r.untimed.empty())
        s.phases = step.times;
      else
        s.untimed = one_line(r.untimed);
      s.ranks = step.ranks;
      s.threads_busy_s = step.threads_busy_s;
      s.barrier_wait_s = step.barrier_wait_s;
      s.counters = step.counted;
      s.work = k == 0 ? r.work : std::nullopt;
      s.peak_rss_bytes = r.peak_rss_bytes;
      s.workspace_bytes = r.workspace_bytes;
      s.lost = step.lost;
      s.threads_worked = step.threads_worked;
      s.verify = {step.checked.max_rel_err, step.checked.bound, fmt::format("{:016x}", step.checked.fingerprint)};
      writer_->write(s);
      sum += step.times.sum_s.value_or(0);
    }
    last_ = r.untimed.empty() ? fmt::format("{}: {:.4g} ms", label(p), 1e3 * sum / static_cast<double>(r.steps.size()))
                              : label(p) + ": no times";
  }

  void advance(double share) { done_ += share; }
  void show(const std::string& what) {
    progress_.show(order_.where.done_s + done_ * order_.where.this_s, order_.where.text + ", " + what);
  }
  void note(const std::string& line) {
    progress_.clear();
    fmt::print("{}\n", one_line(line));
    std::fflush(stdout);
  }

  const order& order_;
  counters hardware_;  // before any thread
  thread_binding binding_;
  environment_row environment_;
  std::unique_ptr<shared_store> store_;
  measuring with_;
  std::unique_ptr<row_writer> writer_;
  progress progress_;
  double done_ = 0;
  std::string last_;
  bool failed_ = false;
};

}  // namespace

int carry_out(const order& o, const registry& all) {
  // A page lies where the thread is that touched it first; one that is kept for the next point would lie where the last
  // point's threads were, which matters with several NUMA nodes.
  if (numa_nodes() == 1) keep_freed_memory();
  errand_run run(o, all);
  const int code = o.what == errand::peaks ? run.peaks() : o.what == errand::verify ? run.verify() : run.measure();
  run.hand_over();
  return code;
}

bool must_fail(const study_plan& plan, const std::string& backend) {
  return plan.self_test && std::ranges::any_of(self_test_entries(), [&](const self_test_entry& e) {
           return e.word == backend && !e.expected_ratio();
         });
}

const registry& registry_of(const study_plan& plan) {
  if (!plan.self_test) return registry::instance();
  static const registry extended = with_self_test(registry::instance());
  return extended;
}

}  // namespace pairsum::harness
