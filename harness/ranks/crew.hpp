#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pairsum/ranks/ranked.hpp>

namespace pairsum::harness {

/// The processes that do the same work together: this one alone, or the ranks of an MPI job. All of them call the same
/// functions in the same order. What one of them alone knows (a file, a clock) decides nothing before it is told.
class crew {
 public:
  crew() = default;
  virtual ~crew() = default;
  crew(const crew&) = delete;
  crew& operator=(const crew&) = delete;

  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// The one that writes rows, files and messages.
  bool is_first() const { return rank() == 0; }

  virtual void barrier() const {}
  /// What each passed, by rank, on all of them.
  virtual std::vector<std::vector<double>> gather(std::span<const double> own) const {
    return {{own.begin(), own.end()}};
  }
  virtual std::vector<std::string> gather(const std::string& own) const { return {own}; }
  /// What the first passed.
  std::string told(const std::string& by_the_first) const;

  /// Work that makes files and reads them: the first does it before the others do the same.
  void in_turn(const std::function<void()>& work) const;

  /// The summation of the whole domain, of which each rank of a job holds a part.
  /// @param cut "twice" or "once"
  virtual std::unique_ptr<summation> share(std::unique_ptr<summation> s, const std::string& cut) const;
  /// Of a summation that was shared, after its evaluation; empty for one alone.
  virtual std::vector<ranks::rank_facts> facts_of(summation&) const { return {}; }
};

/// Those of this process.
const crew& here();
/// This process, as if it were alone.
const crew& alone();

/// Empty if this build has sums over several ranks; else the option that brings them.
std::string why_no_ranks();

/// Does the work as one rank of the MPI job that started this process. Only the first rank writes to stdout; behind all
/// it writes there it tells work_in_a_job() the code of the work. An exception on any rank ends the job, with one line
/// that names the rank. Returns the exit code of this process.
int as_rank(const std::function<int()>& work);

/// What the first rank writes to stdout for the process that started the job: a mark, a word and the end of the line.
inline constexpr std::string_view job_mark = "\x1epairsum ", job_begun = "begun", job_done = "done ";

}  // namespace pairsum::harness
