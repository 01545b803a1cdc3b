#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include <pairsum/sum/profile.hpp>
#include "harness/rows/row.hpp"
#include "harness/tune/tune.hpp"

namespace pairsum::harness {

inline constexpr const char* profile_schema = "pairsum.profile/1";

/// What `pairsum tune` writes: the winner's words, the case and the machine that they are for.
struct saved_profile {
  std::string words;      ///< for parse_profile
  run_request levels;     ///< the case, and the words as levels
  std::string host, cpu;  ///< of the machine
  int cores = 1;
};

/// The levels that make the case of a request.
nlohmann::json case_json(const run_request& r);

/// The profile of a result that has a winner.
nlohmann::json profile_json(const tune_request& r, const tune_result& result, const registry& all);

/// The profile of such a file. Throws pairsum::error with one line that names the file and what is wrong with it.
saved_profile read_profile(const std::string& path);

/// Is there a file, and is it a profile, of whatever version?
bool is_profile(const std::string& path);

/// Does a profile say this level?
bool profile_says(std::string_view level);

/// What is different here from where the profile was made, empty if nothing is.
std::string differences(const saved_profile& p);

}  // namespace pairsum::harness
