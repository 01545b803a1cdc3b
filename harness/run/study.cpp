#include "harness/run/study.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/measure/cpu_time.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/run/estimate.hpp"
#include "harness/run/own_environment.hpp"
#include "harness/run/results_table.hpp"
#include "harness/run/study_file.hpp"
#include "harness/run/worker.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/program.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/terminal.hpp"
#include "harness/verify/shared_store.hpp"

namespace pairsum::harness {
namespace {

class conductor {
 public:
  conductor(const study_plan& plan, const study_options& options, const registry& all)
      : plan_(plan),
        options_(options),
        all_(all),
        hash_(plan_hash(plan)),
        environment_(own_environment(plan, options.binding)),
        file_(options.out, plan, environment_),
        estimate_(plan, all),
        line_(standing{}, plan.budget_s) {
    for (const part_plan& part : plan.parts) {
      auto& threads = most_threads_.emplace_back();
      for (const world_plan& points : expand(part.request, all))
        for (const point& p : points) threads[p.ranks] = std::max(threads[p.ranks], p.threads);
      auto& ranks = ranks_.emplace_back();
      for (const auto& [n, most] : threads) ranks.push_back(n);
    }
    const std::size_t cut = file_.mend();
    if (cut > 0)
      say(fmt::format("{}: a last line that was cut ({} bytes) is taken away", one_line(options.out.string()), cut));
  }

  int run() {
    file_.void_rounds("the round was cut: the study was killed or interrupted");
    if (so_far().open()) say(resuming());
    if (!measure_peaks()) return ended();
    double shares = 0;
    for (const part_plan& part : plan_.parts) shares += part.share;
    for (std::size_t k = 0; k < plan_.parts.size() && code_ == 0; ++k) {
      measure_part(k, shares);
      shares -= plan_.parts[k].share;
    }
    return ended();
  }

 private:
  static constexpr int most_crashes = 2;  ///< in a row, of one round

  void say(const std::string& line) {
    line_.clear();
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  const rows_so_far& so_far() const { return file_.so_far(); }

  std::string resuming() const {
    std::string parts;
    for (const part_plan& p : plan_.parts)
      parts += fmt::format("{}{} of {} {}", parts.empty() ? "" : ", ", so_far().rounds(p.request.part).size(),
                           p.least_rounds == p.most_rounds ? fmt::format("{}", p.most_rounds)
                                                           : fmt::format("{} to {}", p.least_rounds, p.most_rounds),
                           p.request.part);
    return fmt::format("resuming {}: rounds there: {}", one_line(options_.out.string()), parts);
  }

  double left() const { return plan_.budget_s - since_start_.seconds(); }

  /// One process of the first build, or its ranks. False if the study ends here.
  bool carry_out(errand what, std::size_t part, int ranks, double estimated, const std::string& text) {
    for (int crashes = 0; code_ == 0;) {
      const std::size_t store_end = store_.end();
      const departure end = launch(0, order_for(what, part, ranks, estimated, text));
      if (went_well(end)) {
        done_s_ += estimated;
        return true;
      }
      store_.truncate(store_end);
      file_.mend();
      if (code_ == 0) give_up_after(++crashes, text);
    }
    return false;
  }

  /// Has a build carry an order out; the line on the terminal goes on where that leaves it.
  departure launch(std::size_t build, const order& o) {
    line_.begin(o.where);
    line_.show(o.where.done_s, o.where.text);
    const departure end = options_.builds[build](o);
    line_.take_over();
    shown_ = line_.share(o.where.done_s + o.where.this_s);
    return end;
  }

  /// Have these ranks of a part more threads together than the job has cores?
  bool is_crowded(std::size_t part, int ranks) const {
    const auto& threads = most_threads_[part];
    const auto at = threads.find(ranks);
    return at != threads.end() && at->second * ranks > usable_cores() * job_nodes();
  }

  /// Sets the code with which the study ends, if it ends with this departure: a process that was killed is started
  /// again.
  bool went_well(const departure& end) {
    if (interrupted() || end.code == 130) {
      code_ = 130;
    } else if (end.signal == 0 && (end.code > 1 || !end.done)) {
      if (end.code != 2)
        say(fmt::format("a process of the study ended with code {}, before its work was done{}", end.code,
                        options_.builds.size() > 1 ? ": are all programs pairsum, of this version?" : ""));
      code_ = 2;  // with code 2 it has said why
    }
    return code_ == 0 && end.signal == 0;
  }

  static std::string end_of(const departure& end) {
    return end.signal != 0 ? fmt::format("its process was ended by signal {}", end.signal)
                           : fmt::format("its process ended with code {}", end.code);
  }

  void give_up_after(int crashes, const std::string& what) {
    if (crashes <= most_crashes) return;
    say(fmt::format("{} is given up: it was killed {} times in a row", what, crashes));
    code_ = 2;
  }

  order order_for(errand what, std::size_t part, int ranks, double estimated, const std::string& text) {
    file_.read_on();
    order o;
    o.what = what;
    o.plan = plan_;
    o.part = part;
    o.out = options_.out.string();
    o.known = so_far().known();
    o.binding = options_.binding;
    o.store = store_.descriptor();
    o.store_path = fmt::format("/proc/{}/fd/{}", ::getpid(), store_.descriptor());
    o.store_host = environment_.host;
    o.ranks = ranks;
    o.crowded = is_crowded(part, ranks);
    o.where = {
        since_start_.seconds(), done_s_, estimated, std::max(estimate_.all_s(), done_s_ + estimated), shown_, text};
    return o;
  }

  bool measure_peaks() {
    if (!plan_.peaks || interrupted()) return true;
    auto wanted = peaks_of(plan_, all_);
    for (const peak_row& p : so_far().rows().peaks)
      if (p.environment == environment_.environment && p.study == plan_.study) wanted.erase({p.threads, p.precision});
    if (wanted.empty()) return true;
    file_.open();  // the environment's row comes first
    return carry_out(errand::peaks, 0, 1, estimate_.peaks_s(), "the machine's peaks");
  }

  void measure_part(std::size_t k, double shares) {
    const part_plan& part = plan_.parts[k];
    const std::string& name = part.request.part;
    const stopwatch since;
    const double budget = left() * part.share / shares;
    if (so_far().done(part)) return;
    const double verifying = estimate_.verify_s(k);
    if (plan_.budget_s > 0 && k > 0 && verifying + estimate_.round_s(k) > left()) {
      say(fmt::format("{} is left out: {:.0f} s are left of the budget of {:.0f} s, about {:.0f} s are wanted", name,
                      std::max(0.0, left()), plan_.budget_s, verifying + estimate_.round_s(k)));
      left_out_ = true;
      return;
    }
    stopwatch clock;
    for (const int ranks : ranks_[k])
      if (!carry_out(errand::verify, k, ranks, verifying / static_cast<double>(ranks_[k].size()), "verifying " + name))
        return;
    estimate_.verified(k, clock.lap());
    int crashes = 0;
    while (!so_far().done(part) && code_ == 0) {
      if (!affordable(k, since.seconds(), budget)) {
        cut_by_budget_ = true;
        return;
      }
      clock.lap();
      if (!measure_round(k)) {
        if (code_ == 0) give_up_after(++crashes, name);
        continue;
      }
      crashes = 0;
      estimate_.measured(k, clock.lap());
    }
  }

  /// May the budget pay for another round of the part, which has run for `elapsed` of its share's `budget` seconds? Its
  /// first is made in any case; up to its least number as long as each later part can still have one; more if these can
  /// have their least number, and within its share.
  bool affordable(std::size_t k, double elapsed, double budget) const {
    const std::size_t rounds = so_far().rounds(plan_.parts[k].request.part).size();
    if (plan_.budget_s == 0 || rounds == 0) return true;
    const bool more = static_cast<int>(rounds) >= plan_.parts[k].least_rounds;
    double wanted = estimate_.round_s(k);
    for (std::size_t later = k + 1; later < plan_.parts.size(); ++later)
      wanted += estimate_.verify_s(later) + (more ? plan_.parts[later].least_rounds : 1) * estimate_.round_s(later);
    return wanted <= left() && (!more || elapsed + estimate_.round_s(k) <= budget);
  }

  /// One round in all builds, each once for every number of ranks. False if it did not come to its end; then its rows
  /// are voided.
  bool measure_round(std::size_t k) {
    const part_plan& part = plan_.parts[k];
    const int round = so_far().next_round();
    file_.open();  // the environment's row comes first, whichever build begins
    const auto machine_before = machine_time_now();
    const double own_before = own_time();
    double workers_s = 0;
    stopwatch clock;
    const std::vector<int>& ranks = ranks_[k];
    order o = order_for(errand::measure, k, 1, estimate_.round_s(k), so_far().standing(part));
    o.round = round;
    o.where.this_s /= static_cast<double>(options_.builds.size() * ranks.size());
    const std::size_t store_end = store_.end();
    std::uint64_t rows = 0;
    for (const std::size_t process :
         shuffled_order(options_.builds.size() * ranks.size(), part.request.seed, round, 0)) {
      const std::size_t build = process / ranks.size();
      o.ranks = ranks[process % ranks.size()];
      o.crowded = is_crowded(k, o.ranks);
      const departure end = launch(build, o);
      o.where.done_s += o.where.this_s;
      o.where.shown = shown_;
      workers_s += end.cpu_s;
      if (!went_well(end)) {
        store_.truncate(store_end);
        void_round(round, code_ == 130 ? "interrupted" : end_of(end));
        return false;
      }
      file_.read_on();
      o.known = so_far().known();
      if (rows == so_far().samples_of(round)) {
        say(fmt::format("program {} of {} measured nothing: is it pairsum, of this version?", build + 1,
                        options_.builds.size()));
        code_ = 2;
        void_round(round, "a program measured nothing");
        return false;
      }
      rows = so_far().samples_of(round);
    }
    // A process in this one has its time in this one's: nothing is counted twice or left out.
    const double own_s = std::max(workers_s, own_time() - own_before);
    file_.write(round_row{.study = plan_.study,
                          .utc = utc_now(),
                          .environment = environment_.environment,
                          .round = round,
                          .part = part.request.part,
                          .replicate = so_far().next_replicate(part.request.part),
                          .plan = hash_,
                          .seed = part.request.seed,
                          .rows = rows,
                          .elapsed_s = clock.seconds(),
                          .others_share = share_of_others(machine_before, machine_time_now(), own_s)});
    file_.read_on();
    done_s_ += estimate_.round_s(k);
    return true;
  }

  void void_round(int round, const std::string& why) {
    file_.mend();
    file_.void_rounds(why, round);
    file_.read_on();
    if (code_ == 0) say(fmt::format("round {} is voided and measured again: {}", round, why));
  }

  /// The words that go on with this file.
  std::string again() const { return fmt::format("{} --out {}", options_.again, shell_word(options_.out)); }

  void say_next(const std::string& what, const std::string& words) {
    say(fmt::format("rows: {}\n{}:\n  {}{} {}", one_line(options_.out.string()), what,
                    words == again() ? options_.before : "", shell_word(options_.program), words));
  }

  void warn_of_disturbance() {
    const std::string text = disturbance_text(so_far().all_rounds(), so_far().voids());
    if (!text.empty()) say(coloured(tone::doubtful, "warning", has_colours(stdout)) + ": " + text);
  }

  int ended() {
    line_.clear();
    const std::vector<sample> samples = so_far().samples();
    const auto found = rank(
        samples, plan_.builds > 1 ? build_words(so_far().rows().environments) : std::map<std::string, std::string>());
    if (!samples.empty()) fmt::print("{}", results_table(found, has_colours(stdout)));
    warn_of_disturbance();
    if (code_ == 130) say(fmt::format("interrupted; {} finished rounds are kept", so_far().finished()));
    if (code_ != 0) {
      if (so_far().open()) say_next("to go on", again());
      return code_;
    }
    const std::string reason = left_out_        ? "the budget ended before every part was measured"
                               : cut_by_budget_ ? "the budget ended before every part had its rounds"
                                                : "every part has its rounds";
    if (left_out_ || cut_by_budget_) say(fmt::format("{} ({:.0f} s)", reason, plan_.budget_s));
    file_.write(end_row{plan_.study, utc_now(), hash_, reason});
    if (has_intervals(found))
      say_next("tables, figures and a page", fmt::format("report {}", shell_word(options_.out)));
    else
      say_next("more rounds, since 6 give an interval", again());
    const auto failed = [&](const sample& s) { return s.error && !must_fail(plan_, s.point.backend); };
    return std::ranges::any_of(samples, failed) ? 1 : 0;
  }

  const study_plan& plan_;
  const study_options& options_;
  const registry& all_;
  std::vector<std::vector<int>> ranks_;           ///< by part: the numbers of ranks of its points
  std::vector<std::map<int, int>> most_threads_;  ///< by part and number of ranks: the most threads of a rank
  std::string hash_;
  environment_row environment_;
  study_file file_;
  shared_store store_;
  estimate estimate_;
  stopwatch since_start_;
  progress line_;
  double done_s_ = 0, shown_ = 0;  ///< estimated work that is done, and the share that is shown of it
  int code_ = 0;
  bool left_out_ = false, cut_by_budget_ = false;
};

}  // namespace

int conduct(const study_plan& plan, const study_options& options, const registry& all) {
  check_plan(plan, all);
  note_interrupts();
  std::set<int> crowded;
  const int cores = usable_cores() * job_nodes();
  for (const part_plan& part : plan.parts)
    for (const int n : part.request.ranks)
      for (const int t : part.request.threads)
        if (n * t > cores) crowded.insert(n * t);
  for (const int t : crowded) fmt::print("note: {} threads on {} cores\n", t, cores);
  if (const std::string note = limits_note(); !note.empty()) fmt::print("note: {}\n", note);
  return conductor(plan, options, all).run();
}

}  // namespace pairsum::harness
