#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/plan/study.hpp"
#include "harness/rows/reader.hpp"
#include "harness/terminal/progress.hpp"

namespace pairsum::harness {

/// What a process of a study is for.
enum class errand {
  peaks,    ///< measure bandwidth and peak for every number of threads and precision of the plan
  verify,   ///< make the references, verify every point of a part once, keep verdicts for those who come later
  measure,  ///< one round of a part
};

/// What the process that conducts a study tells the one that carries out a step of it.
struct order {
  errand what = errand::measure;
  study_plan plan;
  std::size_t part = 0;  ///< index into the plan's parts
  int round = 1;
  std::string out;    ///< rows file
  known_names known;  ///< what its rows may name, so that it need not be read again
  std::string binding = "cores_first";
  int store = -1;                      ///< descriptor of the shared store; -1: none
  std::string store_path, store_host;  ///< the store for processes that do not inherit it, on that host
  int ranks = 1;                       ///< of the points that it is about, and of those who carry it out
  bool crowded = false;                ///< these have more threads than the job has cores
  standing where;
};

nlohmann::json order_json(const order& o);
/// Throws pairsum::error for an order that another version wrote.
order parse_order(const nlohmann::json& json);

/// How a process that carries out an order ends.
struct departure {
  int code = 0;       ///< exit code: 0 done, 1 done but a point failed its verification, 2 bad input, 130 interrupted
  int signal = 0;     ///< that ended it, if not 0
  double cpu_s = 0;   ///< processor time it used
  bool done = false;  ///< it came to the end of its work and said so; an exit code alone may be a library's
};

}  // namespace pairsum::harness
