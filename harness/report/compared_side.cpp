#include "harness/report/compared_side.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include <pairsum/core/names.hpp>

namespace pairsum::harness {
namespace {

struct level {
  std::string_view name;
  std::string (*word)(const point&);
  void (*copy)(point& to, const point& from);
};

template <auto member>
constexpr level word_level(std::string_view name) {
  return {name, [](const point& p) { return p.*member; },
          [](point& to, const point& from) { to.*member = from.*member; }};
}

constexpr std::array<level, 10> levels{{
    word_level<&point::state>("state"),
    word_level<&point::order>("order"),
    word_level<&point::precision>("precision"),
    word_level<&point::interaction>("interaction"),
    word_level<&point::smoothing>("smoothing"),
    word_level<&point::grid>("grid"),
    {"M", [](const point& p) { return p.M > 0 ? std::to_string(p.M) : std::string("none"); },
     [](point& to, const point& from) { to.M = from.M; }},
    {"threads", [](const point& p) { return std::to_string(p.threads); },
     [](point& to, const point& from) { to.threads = from.threads; }},
    word_level<&point::isa>("isa"),
    word_level<&point::block>("block"),
}};

const level& find_level(std::string_view name) {
  const auto found = std::ranges::find(levels, name, &level::name);
  if (found != levels.end()) return *found;
  std::array<std::string_view, levels.size()> names;
  std::ranges::transform(levels, names.begin(), &level::name);
  throw unknown_name("level", name, names);
}

}  // namespace

compared_side parse_side(const std::string& text) {
  std::istringstream words(text);
  compared_side side;
  words >> side.backend;
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals + 1 == word.size())
      throw error("\"" + word + "\" behind " + side.backend + " is no level with its word, like precision=mixed");
    side.levels[std::string(find_level(word.substr(0, equals)).name)] = word.substr(equals + 1);
  }
  return side;
}

bool is_of(const point& p, const compared_side& side) {
  return p.backend == side.backend &&
         std::ranges::all_of(side.levels, [&](const auto& l) { return find_level(l.first).word(p) == l.second; });
}

point without_differences(point q, const point& p, const compared_side& a, const compared_side& b) {
  for (const compared_side* side : {&a, &b})
    for (const auto& [name, word] : side->levels) {
      find_level(name).copy(q, p);
      if (name == "grid") q.M = p.M;
    }
  return q;
}

}  // namespace pairsum::harness
