#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pairsum::ranks {

/// MPI from its first to its last use in a process, of which there is one. Threads may run beside it, but only the
/// thread that made it calls MPI (MPI_THREAD_FUNNELED). After an error on one rank nothing collective is done here, so
/// that its message is printed; a program that ends then ends the other ranks, too.
class job {
 public:
  /// Throws pairsum::error if MPI does not allow threads.
  job();
  ~job();
  job(const job&) = delete;
  job& operator=(const job&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Returns when all ranks have called it.
  void barrier() const;
  /// What each rank passed, by rank, on all of them; as many numbers from each.
  std::vector<std::vector<double>> gather(std::span<const double> own) const;
  std::vector<std::string> gather(const std::string& own) const;
  /// Sends the message from rank 0 to rank 1 and back, into the same places; both must pass as many bytes. Returns at
  /// once on other ranks. Throws pairsum::error in a job of one rank and for more than 2^31 - 1 bytes.
  void bounce(std::span<std::byte> message) const;
  /// Ends all ranks at once, with this exit code.
  [[noreturn]] static void abort(int code);

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace pairsum::ranks
