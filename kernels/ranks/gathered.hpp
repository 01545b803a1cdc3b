#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

#include <mpi.h>

namespace pairsum::ranks {

/// All ranks' elements on every rank, those of rank r from begin[r] on.
template <class T>
struct of_all_ranks {
  std::vector<T> elements;
  std::vector<int> begin;  ///< one more than ranks
};

template <class T>
of_all_ranks<T> gathered_by_rank(const std::vector<T>& own) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const int n = static_cast<int>(own.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks)), begin(sizes.size() + 1, 0);
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::partial_sum(sizes.begin(), sizes.end(), begin.begin() + 1);
  MPI_Datatype element;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &element);
  MPI_Type_commit(&element);
  std::vector<T> all(static_cast<std::size_t>(begin.back()));
  MPI_Allgatherv(own.data(), n, element, all.data(), sizes.data(), begin.data(), element, MPI_COMM_WORLD);
  MPI_Type_free(&element);
  return {std::move(all), std::move(begin)};
}

template <class T>
std::vector<T> gathered(const std::vector<T>& own) {
  return gathered_by_rank(own).elements;
}

}  // namespace pairsum::ranks
