#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/sum/registry.hpp>
#include "harness/plan/study.hpp"

/// The words of the command line by kind, for `pairsum list`.
namespace pairsum::harness {

/// A word of a kind, and what is to be said of it.
struct listed_word {
  std::string word, text;
  bool here = true;  ///< in this build
};

struct kind_of_word {
  const char* name;     ///< as `list --json` calls it
  const char* missing;  ///< as the registry calls those that are not built, or ""
  std::vector<listed_word> (*entries)(const registry&);
};

/// All kinds, in the order in which they are listed.
const std::vector<kind_of_word>& kinds();

/// The words of a kind, those that are not built too.
std::vector<listed_word> entries_of(const kind_of_word& kind, const registry& r);

/// The plan of that name that comes with the program, for this machine.
study_plan plan_named(std::string_view name);

/// Why this build on this machine cannot carry out the plan as it is; empty if it can.
std::vector<std::string> obstacles(const study_plan& plan);

inline constexpr std::size_t screen = 80;  ///< columns

/// "first" and the words behind it, in lines of a screen's width; all but the first begin with blanks.
std::string filled(std::string line, std::string_view words, std::size_t indent);

}  // namespace pairsum::harness
