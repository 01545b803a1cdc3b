#include <pairsum/ranks/job.hpp>

#include <cstdlib>
#include <exception>
#include <limits>

#include <mpi.h>

#include <pairsum/core/error.hpp>

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
  const int n = static_cast<int>(own.size());
  std::vector<int> sizes(static_cast<std::size_t>(size_)), begins(sizes.size());
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  int total = 0;
  for (std::size_t k = 0; k < sizes.size(); total += sizes[k++]) begins[k] = total;
  std::string all(static_cast<std::size_t>(total), ' ');
  MPI_Allgatherv(own.data(), n, MPI_CHAR, all.data(), sizes.data(), begins.data(), MPI_CHAR, MPI_COMM_WORLD);
  std::vector<std::string> by_rank;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    by_rank.push_back(all.substr(static_cast<std::size_t>(begins[k]), static_cast<std::size_t>(sizes[k])));
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
