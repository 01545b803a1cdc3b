#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include <mpi.h>

#include <pairsum/ranks/exchange.hpp>

#include "ranked_scene.hpp"

// What an exchange says that it sent, against the calls of MPI themselves: those below stand before MPI's own (PMPI).
namespace {

struct counter {
  bool on = false;
  std::uint64_t messages = 0, bytes = 0;
} counted;

void count(int n, MPI_Datatype type, int to) {
  int own = 0, size = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &own);
  PMPI_Type_size(type, &size);
  if (!counted.on || to == own) return;
  ++counted.messages;
  counted.bytes += static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(size);
}

}  // namespace

extern "C" {
int MPI_Send(const void* p, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {
  count(n, t, to);
  return PMPI_Send(p, n, t, to, tag, c);
}
int MPI_Rsend(const void* p, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {
  count(n, t, to);
  return PMPI_Rsend(p, n, t, to, tag, c);
}
int MPI_Isend(const void* p, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request* r) {
  count(n, t, to);
  return PMPI_Isend(p, n, t, to, tag, c, r);
}
}

namespace pairsum::ranks {
namespace {

using test_kit::this_job;

/// Items go to every rank but the own one, rank + 1 of them; each comes back as its double.
TEST(exchange, counts_what_mpi_sends) {
  const int own = this_job().rank(), size = this_job().size();
  std::vector<int> to;
  for (int k = 0; k <= own; ++k)
    for (int rank = 0; rank < size; ++rank)
      if (rank != own) to.push_back(rank);
  const exchange plan(to);
  std::vector<std::byte> items(to.size() * sizeof(int));
  for (std::size_t k = 0; k < to.size(); ++k) {
    const int item = 1000 * own + to[k];
    std::memcpy(items.data() + k * sizeof item, &item, sizeof item);
  }
  traffic forward, back;
  counted = {true, 0, 0};
  std::vector<std::byte> got = plan.forward(items, sizeof(int), forward);
  EXPECT_EQ(counted.messages, forward.messages);
  EXPECT_EQ(counted.bytes, forward.bytes);
  EXPECT_EQ(forward.messages, static_cast<std::uint64_t>(size - 1));
  EXPECT_EQ(forward.bytes, to.size() * sizeof(int));
  EXPECT_EQ(plan.received(), static_cast<std::size_t>(size * (size + 1) / 2 - own - 1)) << "rank + 1 from each other";
  for (std::size_t k = 0; k < plan.received(); ++k) {
    int item = 0;
    std::memcpy(&item, got.data() + k * sizeof item, sizeof item);
    EXPECT_EQ(item % 1000, own);
    item *= 2;
    std::memcpy(got.data() + k * sizeof item, &item, sizeof item);
  }
  counted = {true, 0, 0};
  const std::vector<std::byte> returned = plan.back(got, sizeof(int), back);
  EXPECT_EQ(counted.messages, back.messages);
  EXPECT_EQ(counted.bytes, back.bytes);
  counted.on = false;
  for (std::size_t k = 0; k < to.size(); ++k) {
    int item = 0;
    std::memcpy(&item, returned.data() + k * sizeof item, sizeof item);
    EXPECT_EQ(item, 2 * (1000 * own + to[k]));
  }
}

TEST(exchange, of_nothing) {
  const exchange plan{std::vector<int>()};
  traffic count;
  EXPECT_TRUE(plan.forward({}, 8, count).empty());
  EXPECT_TRUE(plan.back({}, 8, count).empty());
  EXPECT_EQ(count.messages, 0u);
}

}  // namespace
}  // namespace pairsum::ranks
