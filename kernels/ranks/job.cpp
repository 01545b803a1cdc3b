#include <pairsum/ranks/job.hpp>

#include <cstdlib>
#include <exception>
#include <limits>

#include <mpi.h>

#include <pairsum/core/error.hpp>
#include <pairsum/ranks/gathered.hpp>

namespace pairsum::ranks {

job::job() {
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  if (level < MPI_THREAD_FUNNELED) throw error("this MPI allows no threads beside it: ranks need MPI_THREAD_FUNNELED");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

job::~job() {
  if (std::uncaught_exceptions() == 0) MPI_Finalize();  // else others wait for this rank until mpirun ends them
}

void job::barrier() const { MPI_Barrier(MPI_COMM_WORLD); }

std::vector<std::vector<double>> job::gather(std::span<const double> own) const {
  const int n = static_cast<int>(own.size());
  std::vector<double> all(own.size() * static_cast<std::size_t>(size_));
  MPI_Allgather(own.data(), n, MPI_DOUBLE, all.data(), n, MPI_DOUBLE, MPI_COMM_WORLD);
  std::vector<std::vector<double>> by_rank;
  for (auto at = all.begin(); by_rank.size() < static_cast<std::size_t>(size_); at += n)
    by_rank.emplace_back(at, at + n);
  return by_rank;
}

std::vector<std::string> job::gather(const std::string& own) const {
  const auto all = gathered_by_rank(std::vector<char>(own.begin(), own.end()));
  std::vector<std::string> by_rank;
  for (std::size_t k = 0; k < static_cast<std::size_t>(size_); ++k)
    by_rank.emplace_back(all.elements.begin() + all.begin[k], all.elements.begin() + all.begin[k + 1]);
  return by_rank;
}

void job::bounce(std::span<std::byte> message) const {
  if (size_ < 2) throw error("a message needs two ranks, this job has one");
  if (message.size() > std::numeric_limits<int>::max())
    throw error("a message may have up to 2^31 - 1 bytes, has " + std::to_string(message.size()));
  if (rank_ > 1) return;
  const int bytes = static_cast<int>(message.size()), other = 1 - rank_, tag = 1963;
  const auto send = [&] { MPI_Send(message.data(), bytes, MPI_BYTE, other, tag, MPI_COMM_WORLD); };
  const auto receive = [&] {
    MPI_Recv(message.data(), bytes, MPI_BYTE, other, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  };
  if (rank_ == 0) send();
  receive();
  if (rank_ == 1) send();
}

void job::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

}  // namespace pairsum::ranks
