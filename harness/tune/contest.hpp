#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The search of `pairsum tune`, without a clock or a sum of its own.
namespace pairsum::harness {

/// What became of a candidate.
enum class fate {
  not_seen,   ///< the time ended before a look at it
  passed_by,  ///< others of its family had been far too slow
  wrong,      ///< its rates were wrong
  slow,       ///< its looks were far too slow
  worse,      ///< dropped: its interval against the best was clearly above 1
  halved,     ///< dropped as one of the slower half, so that the time lasts for the others
  standing    ///< measured to the end
};

constexpr std::string_view name_of(fate f) {
  constexpr std::string_view names[]{"not_seen", "passed_by", "wrong", "slow", "worse", "halved", "standing"};
  return names[static_cast<unsigned>(f)];
}

struct contestant {
  std::string family;            ///< candidates of one algorithm; a slow one speaks for the rest
  fate what = fate::not_seen;    ///< set by the search
  std::optional<double> look_s;  ///< the shortest of its looks, which other programs disturbed least
  double cost_s = 0;             ///< that one measurement of it takes, everything included
  std::map<int, double> times;   ///< by round
  std::string error;             ///< of a wrong one
};

/// What the search needs of the world around it.
struct contest_world {
  /// Measures a candidate once: seconds, or nothing with `error` set if its rates were wrong.
  std::function<std::optional<double>(std::size_t candidate, std::string& error)> measure;
  std::function<double()> left_s;     ///< of the budget
  std::function<bool()> interrupted;  ///< then the search ends as soon as it can
  std::function<void(const std::string& text)> show = [](const std::string&) {};
};

struct contest_rules {
  int looks = 3;                ///< at a candidate, the second and third only in the first half of the time
  double share_of_looks = 0.6;  ///< of the time, at most, for a first look at each
  double far_too_slow = 1.5;    ///< as a multiple of the fastest look
  std::size_t fewest = 6;       ///< that get rounds, far too slow or not, if there is the time
  int least_rounds = 6;         ///< an interval of a median needs them
  int most_rounds = 40;
  double drop_level = 0.999;  ///< confidence of the interval that drops a candidate; it is asked after every round
  std::uint64_t seed = 1;
};

/// Successive halving with paired rounds. First come looks at the candidates in the given order, but for those of a
/// family whose best look took more than twice the fastest one; the far too slow are set aside. Then come rounds, in
/// each of which all that remain are measured once in a shuffled order. After at least 3 rounds those are dropped whose
/// paired interval against the best lies above 1; after every 6 rounds, and whenever the time left does not pay for 6
/// of all, the slower half. It ends when the time does, after the most rounds, or when one remains and has its least
/// rounds.
void contend(std::vector<contestant>& all, const contest_rules& rules, const contest_world& world);

/// The fastest of those that remain (by the mean of the logarithms over their rounds; without any round by the looks);
/// empty if nothing was measured.
std::optional<std::size_t> winner_of(const std::vector<contestant>& all);

}  // namespace pairsum::harness
