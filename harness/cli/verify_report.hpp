#pragma once
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include <pairsum/cases/case.hpp>
#include "harness/verify/verify_all.hpp"

namespace pairsum::harness {

inline constexpr const char* verify_schema = "pairsum.verify/1";

/// Where the lines go: to stdout, or with a JSON document there to stderr; of several ranks the first alone is heard.
std::FILE* line_stream(bool json);

/// What `pairsum verify` prints: a line per formula, or per sum, as they are made, and how many agree. With `json` the
/// lines go to stderr, and stdout gets one document (verify.schema.json) in the end.
class verify_report {
 public:
  verify_report(bool each, bool json);

  /// The sums that follow are of this world.
  void begin(const std::string& case_name, double dx, const std::string& state, const initial_condition& c);
  void add(const verify_line& l);
  /// Prints what is left to say; returns whether all sums agree.
  bool end();

 private:
  void close_formula();

  bool each_, json_, colours_;
  std::FILE* lines_;
  nlohmann::json worlds_ = nlohmann::json::array();
  int dim_ = 0;
  std::size_t made_ = 0, failed_ = 0;
  // Of the formula under way.
  std::string formula_, worst_backend_;
  std::size_t here_ = 0, failed_here_ = 0;
  double worst_ = 0;
};

}  // namespace pairsum::harness
