#include <pairsum/core/granularity.hpp>

#include <charconv>
#include <vector>

#include <pairsum/core/error.hpp>

namespace pairsum {
namespace {

struct named {
  std::string_view name;
  loop_schedule what;
  runtime where;
};

constexpr named schedules[] = {
    {"dynamic", loop_schedule::dynamic, runtime::omp}, {"static", loop_schedule::fixed, runtime::omp},
    {"guided", loop_schedule::guided, runtime::omp},   {"auto", loop_schedule::automatic, runtime::tbb},
    {"simple", loop_schedule::simple, runtime::tbb},   {"static", loop_schedule::fixed, runtime::tbb},
};

[[noreturn]] void reject(std::string_view word, runtime r) {
  std::string text = "a granularity of " + std::string(r == runtime::omp ? "OpenMP" : "oneTBB") + " is ";
  for (const named& s : schedules)
    if (s.where == r) text += std::string(s.name) + ":N, ";
  throw error(text + "N from 1" + (r == runtime::omp ? " (static also 0: one piece per thread)" : "") +
              ", or default, not \"" + std::string(word) + "\"");
}

}  // namespace

std::string name_of(const granularity& g) {
  for (const named& s : schedules)
    if (s.what == g.how) return std::string(s.name) + ":" + std::to_string(g.chunk);
  return "none";
}

granularity parse_granularity(std::string_view word, runtime r) {
  if (r == runtime::serial) return {};
  const std::size_t colon = word.find(':');
  if (colon == word.npos) reject(word, r);
  for (const named& s : schedules) {
    if (s.where != r || s.name != word.substr(0, colon)) continue;
    granularity g{s.what, 0};
    const char* const end = word.data() + word.size();
    const auto [stop, failed] = std::from_chars(word.data() + colon + 1, end, g.chunk);
    const std::size_t least = s.what == loop_schedule::fixed && r == runtime::omp ? 0 : 1;
    if (failed != std::errc{} || stop != end || g.chunk < least || g.chunk > 1000000000) reject(word, r);
    return g;
  }
  reject(word, r);
}

}  // namespace pairsum
