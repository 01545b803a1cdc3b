#include <pairsum/ranks/exchange.hpp>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include <mpi.h>
#include <zoltan_comm.h>

#include <pairsum/core/error.hpp>

namespace pairsum::ranks {
namespace {

constexpr int tag = 2009;

void check(int code, const char* what) {
  if (code < 0) throw error(std::string("Zoltan could not ") + what + " (code " + std::to_string(code) + ")");
}

/// MPI counts bytes as int.
void check_bytes(std::size_t items, std::size_t size) {
  if (items * size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw error("a rank has " + std::to_string(items) +
                " particles to exchange at once, more than 2 GiB: use more ranks");
}

/// Zoltan takes items of at least one byte, and pointers that are not null.
char* bytes(std::vector<std::byte>& v) {
  v.reserve(1);
  return reinterpret_cast<char*>(v.data());
}

}  // namespace

exchange::exchange(std::vector<int> to) : to_(std::move(to)) {
  check_bytes(to_.size(), 1);
  int received = 0;
  to_.reserve(1);
  check(Zoltan_Comm_Create(&plan_, static_cast<int>(to_.size()), to_.data(), MPI_COMM_WORLD, tag, &received),
        "plan an exchange");
  received_ = static_cast<std::size_t>(received);
  int own = 0, ranks = 1, senders = 0, self = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<int> sender(static_cast<std::size_t>(ranks) + 1), items(sender.size());
  check(Zoltan_Comm_Info(plan_, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, &senders, sender.data(),
                         items.data(), nullptr, nullptr, nullptr, &self),
        "describe an exchange");
  for (std::size_t k = 0; k < static_cast<std::size_t>(senders + self); ++k)
    if (sender[k] != own && items[k] > 0) {
      ++in_.messages;
      in_.bytes += static_cast<std::uint64_t>(items[k]);
    }
  std::vector<bool> seen(static_cast<std::size_t>(ranks), false);
  for (const int rank : to_)
    if (rank != own) {
      out_.messages += !seen[static_cast<std::size_t>(rank)];
      seen[static_cast<std::size_t>(rank)] = true;
      ++out_.bytes;
    }
}

exchange::~exchange() {
  // Collective: after an error on one rank the others are elsewhere.
  if (plan_ != nullptr && std::uncaught_exceptions() == 0) Zoltan_Comm_Destroy(&plan_);
}

void exchange::swap(exchange& o) noexcept {
  std::swap(plan_, o.plan_);
  std::swap(to_, o.to_);
  std::swap(received_, o.received_);
  std::swap(out_, o.out_);
  std::swap(in_, o.in_);
}

std::vector<std::byte> exchange::forward(const std::vector<std::byte>& items, std::size_t size, traffic& count) const {
  check_bytes(std::max(received_, to_.size()), size);
  std::vector<std::byte> got(received_ * size), out = items;
  check(Zoltan_Comm_Do(plan_, tag, bytes(out), static_cast<int>(size), bytes(got)), "exchange particles");
  count.messages += out_.messages;
  count.bytes += out_.bytes * size;
  return got;
}

std::vector<std::byte> exchange::back(const std::vector<std::byte>& items, std::size_t size, traffic& count) const {
  check_bytes(std::max(received_, to_.size()), size);
  std::vector<std::byte> got(to_.size() * size), out = items;
  check(Zoltan_Comm_Do_Reverse(plan_, tag, bytes(out), static_cast<int>(size), nullptr, bytes(got)), "send rates back");
  count.messages += in_.messages;
  count.bytes += in_.bytes * size;
  return got;
}

}  // namespace pairsum::ranks
