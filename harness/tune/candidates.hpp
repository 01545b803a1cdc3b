#pragma once
#include <vector>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// The points of a request in the order in which `pairsum tune` looks at them: of every backend and precision first
/// one, with the most threads, then the second of each, and so on. Throws pairsum::error unless the request names one
/// world but for its precisions.
std::vector<point> candidates_of(const run_request& r, const registry& all);

/// Is the point's isa worth a word? Not `scalar` of a backend that is made for no vector units.
bool says_isa(const point& p, const registry& all);

/// Whose slow look speaks for the rest.
std::string family_of(const point& p);

/// What a candidate is, in words of the command line that tell it from the others: "--backend naive --grid ..."; with
/// isa, block and granularity where the backend takes them.
std::string options_of(const point& p, const registry& all);

/// The same as words of a profile: "backend=naive grid=hashed_grid M=6 ...".
std::string profile_words(const point& p, const registry& all);

/// The request's case as options: "--case dam_break --dx 0.02 ...".
std::string case_options(const run_request& r);

}  // namespace pairsum::harness
