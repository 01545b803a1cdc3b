#include "harness/report/compare_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include "harness/report/builds.hpp"
#include "harness/report/compared_points.hpp"
#include "harness/report/compared_side.hpp"
#include "harness/report/report.hpp"
#include "harness/report/text_table.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/rows/reader.hpp"
#include "harness/stats/holm.hpp"

namespace pairsum::harness {
namespace {

enum class kind { backends, files, revisions };

bool is_path(const std::string& word) {
  std::error_code code;
  return std::filesystem::exists(word, code);
}

std::set<std::string> backends_in(const std::vector<rows_file>& files) {
  std::set<std::string> names;
  for (const rows_file& f : files)
    for (const sample& s : f.samples) names.insert(s.point.backend);
  return names;
}

bool is_revision(const std::string& word, const environment_row& e) {
  return word.size() >= 4 && (e.git.starts_with(word) || (!e.git.empty() && word.starts_with(e.git)));
}

/// The revisions that wrote rows; of these, those that a word means, if it is given.
std::set<std::string> revisions_in(const std::vector<rows_file>& files, const std::string& word = "") {
  std::set<std::string> names;
  for (const rows_file& f : files)
    for (const environment_row& e : f.environments)
      if (word.empty() || is_revision(word, e)) names.insert(e.git);
  return names;
}

/// The rows that one revision wrote.
std::vector<rows_file> of_revision(std::vector<rows_file> files, const std::string& revision) {
  for (rows_file& f : files) {
    std::set<std::string> own;
    for (const environment_row& e : f.environments)
      if (is_revision(revision, e)) own.insert(e.environment);
    std::erase_if(f.samples, [&](const sample& s) { return !own.contains(s.environment); });
    std::erase_if(f.environments, [&](const environment_row& e) { return !own.contains(e.environment); });
    std::erase_if(f.paces, [&](const pace_row& p) { return !own.contains(p.environment); });
    std::erase_if(f.peaks, [&](const peak_row& p) { return !own.contains(p.environment); });
  }
  return files;
}

/// The first word: what is behind it is read when it is known to be a backend.
std::string backend_of(const std::string& side) { return side.substr(0, side.find(' ')); }

kind kind_of(const compare_request& r, const std::vector<rows_file>& files) {
  if (files.empty()) return kind::files;
  const auto backends = backends_in(files);
  if (backends.contains(backend_of(r.a)) && backends.contains(backend_of(r.b))) return kind::backends;
  const auto of_a = revisions_in(files, r.a), of_b = revisions_in(files, r.b);
  if (!of_a.empty() && of_a == of_b)
    throw error(fmt::format("\"{}\" and \"{}\" both name the revision {}", r.a, r.b, join(of_a)));
  if (!of_a.empty() && !of_b.empty()) return kind::revisions;
  if (backends.contains(r.a) || backends.contains(r.b)) {
    const bool a_is_backend = backends.contains(r.a);
    if (!(a_is_backend ? of_b : of_a).empty())
      throw error(fmt::format("\"{}\" is a backend, \"{}\" a revision; a comparison takes two of the same kind",
                              a_is_backend ? r.a : r.b, a_is_backend ? r.b : r.a));
  }
  const std::string& wrong = backends.contains(r.a) || !of_a.empty() ? r.b : r.a;
  throw error(
      fmt::format("\"{}\" is neither a backend nor a revision of these rows; there are the backends {} and the "
                  "revisions {}",
                  wrong, join(backends), join(revisions_in(files))));
}

/// What else differs between the two sides; what must not be mixed is refused.
std::string differences(const compare_request& r, const measurements& a, const measurements& b) {
  builds both;
  std::set<std::string> hosts;
  bool dirty = false;
  for (const measurements* m : {&a, &b})
    for (const environment_row& e : m->environments) {
      both.add(e);
      hosts.insert(e.host + ", " + e.cpu);
      dirty = dirty || e.dirty;
    }
  const std::string text = both.differences();
  if (r.allow_mixed) return text;
  if (hosts.size() > 1)
    throw error("the two were measured on different machines (" + text +
                "), which says nothing of the programs; --allow-mixed compares them nevertheless");
  if (dirty)
    throw error("rows were built from a tree with uncommitted changes (" + text +
                "), which no revision names; --allow-mixed compares them nevertheless");
  return text;
}

struct compared {
  const measured_point *a, *b;
  ratio_estimate ratio;
};

/// Do two backends, each with its fastest granularity, or two builds do the same?
bool do_the_same(const compare_request& r, kind what, const compared_side& a, const compared_side& b,
                 const measurements& all, const measured_point& p, const measured_point& q) {
  point like = q.point;
  if (what != kind::backends) return like == p.point;
  const series &of_p = all.series[p.series], &of_q = all.series[q.series];
  if (of_p.build != of_q.build || of_p.seed != of_q.seed) return false;
  if (&p == &q || !is_of(p.point, a) || !is_of(q.point, b)) return false;
  if (p.point.block == "none" || q.point.block == "none") like.block = p.point.block;
  if (have_like_isa(p.point, q.point)) like.isa = p.point.isa;
  like = without_differences(like, p.point, a, b);
  like.backend = a.backend;
  like.granularity = p.point.granularity;
  return like == p.point && has_best_granularity(all, p, r.phase) && has_best_granularity(all, q, r.phase);
}

bool share_a_round(const measured_point& p, const measured_point& q) {
  return std::ranges::any_of(p.rounds, [&](const auto& round) { return q.rounds.contains(round.first); });
}

/// Every point of side a with its counterpart on side b.
std::vector<compared> pairs_of(const compare_request& r, kind what, const measurements& a, const measurements& b) {
  compared_side side_a, side_b;
  if (what == kind::backends) side_a = parse_side(r.a), side_b = parse_side(r.b);
  std::vector<compared> found;
  std::vector<std::string> unsaid;  // that sides are not paired is said once
  for (const measured_point& p : a.points)
    for (const measured_point& q : b.points) {
      if (!comparable_time(p, r.phase) || !comparable_time(q, r.phase)) continue;
      if (a.series[p.series].study != b.series[q.series].study || !do_the_same(r, what, side_a, side_b, a, p, q))
        continue;
      found.push_back({&p, &q,
                       share_a_round(p, q) && what != kind::files
                           ? ratio_of(a, p, q, unsaid, r.phase)
                           : unpaired_ratio(values_of(p, r.phase), values_of(q, r.phase))});
    }
  return found;
}

/// The words of a point that are the same in most studies.
std::string rare_words(const point& p) {
  return fmt::format("{} {} {} {} {} H={} {}D", p.precision, p.interaction, p.smoothing, p.integrator, p.order, p.H,
                     p.dim);
}

/// Which vector units and blocks, if any.
std::string variant_of(const point& p) {
  return (p.isa == scalar_isa ? "" : " " + p.isa) + (p.block == "none" || p.block == "auto" ? "" : " " + p.block);
}

/// That of a point and its counterpart: once if they have the same or only one of them has any, else "this / that".
std::string variants_of(const point& p, const point& q) {
  const std::string a = variant_of(p), b = variant_of(q);
  return a == b || b.empty() ? a : a.empty() ? b : a + " /" + b;
}

/// What a point and its counterpart are, in the words that tell the pairs apart.
std::string place(const point& p, const point& q, kind what, bool with_rare_words) {
  const auto both = [](const std::string& a, const std::string& b) { return a == b ? a : a + "/" + b; };
  return fmt::format("{}{} {} dx={} {} threads={}{}{}", what == kind::backends ? "" : p.backend + " ", p.case_name,
                     both(p.state, q.state), p.dx, both(cells_word(p), cells_word(q)),
                     both(std::to_string(p.threads), std::to_string(q.threads)), variants_of(p, q),
                     with_rare_words ? " " + rare_words(p) : "");
}

std::string table_of(const compare_request& r, kind what, const std::vector<compared>& pairs) {
  std::vector<ratio_estimate> ratios;
  for (const compared& c : pairs) ratios.push_back(c.ratio);
  const std::vector<ratio_verdict> verdicts = verdicts_of(ratios);
  text_table table({"point", "rounds", "A ms", "B ms", "A/B", "[low, high]", "B is"}, 1);
  std::set<std::pair<double, std::string>> rare;  // words by dx, which decides H
  for (const compared& c : pairs) rare.emplace(c.a->point.dx, rare_words(c.a->point));
  std::set<double> sizes;
  for (const auto& [dx, words] : rare) sizes.insert(dx);
  int faster = 0, slower = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const compared& c = pairs[k];
    faster += verdicts[k] == ratio_verdict::faster;
    slower += verdicts[k] == ratio_verdict::slower;
    table.add({place(c.a->point, c.b->point, what, rare.size() > sizes.size()),
               fmt::format("{}/{}", c.a->rounds.size(), c.b->rounds.size()), ms(*median_of(*c.a, r.phase)),
               ms(*median_of(*c.b, r.phase)), fmt::format("{:.3f}", c.ratio.value),
               c.ratio.bounds ? fmt::format("[{:.3f}, {:.3f}]", c.ratio.bounds->low, c.ratio.bounds->high)
                              : std::string("too few rounds"),
               std::string(word_of(verdicts[k]))});
  }
  return table.text() + fmt::format(
                            "Of {} comparison{} B is faster in {}, slower in {}, no difference is resolved in {} "
                            "(95 % confidence over all of them).\n",
                            pairs.size(), pairs.size() == 1 ? "" : "s", faster, slower,
                            static_cast<int>(pairs.size()) - faster - slower);
}

}  // namespace

std::string compare_sides(const compare_request& r) {
  if (r.a == r.b) throw error("a comparison needs two different things, not \"" + r.a + "\" twice");
  const bool files = is_path(r.a) && is_path(r.b);
  if (!files && is_path(r.a) != is_path(r.b))
    throw error(
        fmt::format("\"{}\" is a file, \"{}\" is none; a comparison takes two backends, two rows files or two "
                    "revisions",
                    is_path(r.a) ? r.a : r.b, is_path(r.a) ? r.b : r.a));
  const std::vector<rows_file> rows = files ? std::vector<rows_file>{} : read_all_rows(r.inputs);
  const kind what = kind_of(r, rows);
  measurements a, b;
  if (what == kind::files) {
    a = collect(read_all_rows({r.a}), false);
    b = collect(read_all_rows({r.b}), false);
  } else if (what == kind::revisions) {
    a = collect(of_revision(rows, r.a), false);
    b = collect(of_revision(rows, r.b), false);
  } else {
    a = collect(rows, r.allow_mixed);
  }
  if (what != kind::backends)
    for (const auto& [side, name] : {std::pair(&a, r.a), std::pair(&b, r.b)})
      if (side->compares_builds)
        throw error(
            fmt::format("\"{}\" holds rows of several builds, and a comparison takes one a side; pairsum report "
                        "compares them",
                        name));
  const measurements& other = what == kind::backends ? a : b;
  const std::string differ = what == kind::backends ? "" : differences(r, a, other);
  const std::vector<compared> pairs = pairs_of(r, what, a, other);
  if (pairs.empty())
    throw error(fmt::format("\"{}\" and \"{}\" have no point in common (same study, case, dx, grid, M, threads{})", r.a,
                            r.b, what == kind::backends ? "" : ", backend"));
  std::string text = fmt::format("A: {}\nB: {}\n", r.a, r.b);
  if (std::ranges::any_of(pairs, [](const compared& c) { return c.ratio.pairs == 0; }))
    text += wrapped("measured apart, so not paired: what disturbed one of them alone is in the ratio");
  if (!differ.empty()) text += wrapped("they differ in " + differ);
  for (const measurements* m : {&a, &b})
    for (const failed_point& f : m->failed)
      text += fmt::format("left out, not verified: {}: {}\n", label(f.point), f.error);
  return text + table_of(r, what, pairs);
}

}  // namespace pairsum::harness
