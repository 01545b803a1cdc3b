#include "harness/cli/verify_report.hpp"

#include <fmt/format.h>

#include <pairsum/sum/grids.hpp>
#include "harness/environment/environment.hpp"
#include "harness/plan/plan.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/rows/json_parts.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

/// 0 where the grid takes none.
int M_of(const setup& s) { return grid_takes_M(s.grid) ? s.M : 0; }

std::string cells_of(const setup& s) {
  point p;
  p.grid = s.grid;
  p.M = M_of(s);
  return cells_word(p);
}

nlohmann::json sum_json(const verify_line& l) {
  const setup& s = l.sum;
  nlohmann::json j{{"precision", s.precision},
                   {"interaction", s.interaction},
                   {"smoothing", s.smoothing == no_smoothing ? nlohmann::json() : nlohmann::json(s.smoothing)},
                   {"backend", s.backend},
                   {"grid", s.grid},
                   {"M", M_of(s) > 0 ? nlohmann::json(M_of(s)) : nlohmann::json()},
                   {"isa", s.isa},
                   {"block", s.block},
                   {"threads", l.threads},
                   {"error_over_bound", finite(l.share)},
                   {"failure", l.ok ? nlohmann::json() : nlohmann::json(l.error)}};
  if (here().size() > 1) j.update({{"ranks", here().size()}, {"cut", l.cut}});
  return j;
}

}  // namespace

std::FILE* line_stream(bool json) { return json && here().is_first() ? stderr : stdout; }

verify_report::verify_report(bool each, bool json)
    : each_(each), json_(json), colours_(has_colours(json ? stderr : stdout)), lines_(line_stream(json)) {}

void verify_report::begin(const std::string& case_name, double dx, const std::string& state,
                          const initial_condition& c) {
  close_formula();
  formula_.clear();
  dim_ = c.particles.dim;
  const auto fluid = c.particles.count(particle_kind::fluid), boundary = c.particles.count(particle_kind::boundary);
  fmt::print(lines_, "{} {}D dx={} {}: {} fluid, {} boundary particles; largest error in units of its bound\n",
             case_name, dim_, dx, state, fluid, boundary);
  worlds_.push_back({{"case", case_name},
                     {"dim", dim_},
                     {"dx", dx},
                     {"H", c.H},
                     {"state", state},
                     {"n_fluid", fluid},
                     {"n_boundary", boundary},
                     {"sums", nlohmann::json::array()}});
}

void verify_report::add(const verify_line& l) {
  const setup& s = l.sum;
  if (json_) worlds_.back()["sums"].push_back(sum_json(l));
  const std::string formula = fmt::format("{}D  {:<8}{:<12}{:<14}", dim_, s.precision, s.interaction, s.smoothing);
  if (formula != formula_) close_formula();
  formula_ = formula;
  ++made_;
  ++here_;
  failed_ += !l.ok;
  failed_here_ += !l.ok;
  if (l.share >= worst_) worst_ = l.share, worst_backend_ = s.backend;
  const std::string chosen = " " + s.isa + (s.block == "auto" ? "" : " " + s.block);
  const std::string threads =
      std::to_string(l.threads) + (here().size() > 1 ? fmt::format(" ranks={} {} ", here().size(), l.cut) : "");
  if (each_ || !l.ok)
    fmt::print(lines_, "{}{:<17} {:<13} threads={:<4}{}\n", formula, s.backend + chosen, cells_of(s), threads,
               l.ok ? fmt::format("{:.3g}", l.share) : coloured(tone::bad, "FAILED: ", colours_) + l.error);
  std::fflush(lines_);
}

void verify_report::close_formula() {
  if (here_ > 0 && !each_)
    fmt::print(lines_, "{}{:>5} sums   {}\n", formula_, here_,
               failed_here_ > 0 ? coloured(tone::bad, fmt::format("{} FAILED", failed_here_), colours_)
               : worst_ > 0     ? fmt::format("{:.3g} ({})", worst_, worst_backend_)
                                : "exact");
  std::fflush(lines_);
  here_ = failed_here_ = 0;
  worst_ = 0;
}

bool verify_report::end() {
  close_formula();
  const std::string verdict = fmt::format("{} of {} sums agree with the reference", made_ - failed_, made_);
  fmt::print(lines_, "{}\n", coloured(failed_ == 0 ? tone::good : tone::bad, verdict, colours_));
  std::fflush(lines_);
  if (json_)
    fmt::print("{}\n", nlohmann::json{{"schema", verify_schema},
                                      {"environment", provenance()},
                                      {"sums", made_},
                                      {"failed", failed_},
                                      {"worlds", worlds_}}
                           .dump(2));
  return failed_ == 0;
}

}  // namespace pairsum::harness
