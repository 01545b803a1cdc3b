#include "harness/ranks/mpi_crew.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <thread>

#include <pairsum/ranks/job.hpp>
#include "harness/terminal/program.hpp"

namespace pairsum::harness {
namespace {

class mpi_crew final : public crew {
 public:
  int rank() const override { return job_.rank(); }
  int size() const override { return job_.size(); }
  void barrier() const override { job_.barrier(); }
  std::vector<std::vector<double>> gather(std::span<const double> own) const override { return job_.gather(own); }
  std::vector<std::string> gather(const std::string& own) const override { return job_.gather(own); }

  std::unique_ptr<summation> share(std::unique_ptr<summation> s, const std::string& cut) const override {
    if (size() == 1) return s;
    return ranks::make_ranked(std::move(s), {.pairs = cut == "once" ? cut_pairs::once : cut_pairs::twice});
  }
  std::vector<ranks::rank_facts> facts_of(summation& s) const override {
    return size() == 1 ? std::vector<ranks::rank_facts>{} : ranks::facts_of(s);
  }

 private:
  ranks::job job_;
};

/// Ends the job with one line. Most errors are of all ranks: the first says its own at once, and ends the others while
/// these wait for their turn.
[[noreturn]] void end_with(const crew& all, const std::string& what) {
  constexpr int longest_wait = 6;
  std::this_thread::sleep_for(std::chrono::milliseconds(500) * std::min(all.rank(), longest_wait));
  complain(fmt::format("rank {}: {}", all.rank(), what));
  ranks::job::abort(2);
}

void tell(const std::string& word) {
  fmt::print("{}{}\n", job_mark, word);
  std::fflush(stdout);
}

/// Only the first rank is heard.
void be_silent() {
  const int nothing = ::open("/dev/null", O_WRONLY);
  if (nothing < 0) return;
  ::dup2(nothing, STDOUT_FILENO);
  ::close(nothing);
}

}  // namespace

std::string why_no_ranks() { return ""; }

int as_rank(const std::function<int()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a rank dies with what started it
  const mpi_crew all;
  make_present(all);
  if (all.is_first())
    tell(std::string(job_begun));
  else
    be_silent();
  try {
    const int code = work();
    if (all.is_first()) tell(std::string(job_done) + std::to_string(code));
    all.barrier();
    return 0;
  } catch (const std::bad_alloc&) {
    end_with(all, "out of memory; a larger dx, or ranks on more nodes, need less each");
  } catch (const std::exception& e) {
    end_with(all, e.what());
  }
}

}  // namespace pairsum::harness
