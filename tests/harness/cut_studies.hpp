#pragma once
#include <algorithm>
#include <csignal>
#include <set>

#include "harness/environment/environment.hpp"
#include "study_fixture.hpp"

// Studies whose processes end before their time.
namespace pairsum::harness {

/// Thrown where the study's own process is killed.
struct killed {};

/// In this process, but calls `before_end(order, how often it was called)` when the rows of an order are written.
inline launcher watched(std::function<departure(const order&, int)> before_end,
                        const registry& all = registry::instance()) {
  return [&all, before_end = std::move(before_end), n = 0](const order& o) mutable {
    const departure end = in_this_process(all)(o);
    const departure instead = before_end(o, ++n);
    return instead.code != 0 || instead.signal != 0 ? instead : end;
  };
}

/// Ends so at the rounds with these numbers.
inline launcher ending(std::set<int> rounds, departure how) {
  return watched(
      [=](const order& o, int) { return o.what == errand::measure && rounds.count(o.round) != 0 ? how : departure{}; });
}

class cut_study : public study_test {
 protected:
  static constexpr departure signal_9{0, SIGKILL, 0}, interrupt{130, 0, 0};

  int conduct_with(launcher l) { return conduct_here(plan_, path_, registry::instance(), {std::move(l)}); }
  int conduct_again() { return conduct_here(plan_, path_); }

  /// The study's process is killed when the rows of that round are written.
  void kill_in_round(int round) {
    EXPECT_THROW(conduct_with(watched([=](const order& o, int) -> departure {
                   if (o.what == errand::measure && o.round == round) throw killed{};
                   return {};
                 })),
                 killed);
  }

  /// Every replicate of every part is there once, and nothing else counts.
  void expect_whole() const {
    const rows_file rows = read_rows(path_);
    std::multiset<std::pair<std::string, int>> found, wanted;
    for (const round_row& r : rows.finished_rounds()) found.emplace(r.part, r.replicate);
    for (const part_plan& p : plan_.parts)
      for (int k = 1; k <= p.most_rounds; ++k) wanted.emplace(p.request.part, k);
    EXPECT_EQ(found, wanted);
    EXPECT_TRUE(rows.unfinished_rounds().empty());
    EXPECT_EQ(rows.ends.size(), 1u);
    EXPECT_EQ(rows.valid_samples().size(), found.size() * 2);
  }

  std::vector<int> voided() const {
    std::vector<int> rounds;
    for (const void_row& v : read_rows(path_).voids) rounds.push_back(v.round);
    return rounds;
  }

  void expect_refused(const std::string& says) {
    const std::string before = text_of(path_);
    try {
      conduct_again();
      ADD_FAILURE() << "accepted, should say: " << says;
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(text_of(path_), before);
  }

  study_plan plan_ = study_of({small_part("a", 2), small_part("b", 2)});
};

}  // namespace pairsum::harness
