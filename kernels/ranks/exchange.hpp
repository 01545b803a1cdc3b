#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pairsum/ranks/ranked.hpp>

struct Zoltan_Comm_Obj;

namespace pairsum::ranks {

/// Which items go to which rank, and how many come: a plan of Zoltan_Comm, used once or many times, in both directions.
/// Items are bytes. All functions are collective. Nothing goes to the own rank unless it is named.
class exchange {
 public:
  exchange() = default;
  /// Item k goes to rank to[k].
  explicit exchange(std::vector<int> to);
  ~exchange();
  exchange(exchange&& o) noexcept { swap(o); }
  exchange& operator=(exchange&& o) noexcept {
    swap(o);
    return *this;
  }

  std::size_t sent() const { return to_.size(); }
  std::size_t received() const { return received_; }

  /// Sends items of `size` bytes in the order of the plan; returns those received, in the order of their ranks. Adds
  /// what other ranks got to `count`.
  std::vector<std::byte> forward(const std::vector<std::byte>& items, std::size_t size, traffic& count) const;
  /// Sends one item for each that was received, back to where that came from; returns them in the order of the plan.
  std::vector<std::byte> back(const std::vector<std::byte>& items, std::size_t size, traffic& count) const;

 private:
  void swap(exchange& o) noexcept;

  Zoltan_Comm_Obj* plan_ = nullptr;
  std::vector<int> to_;
  std::size_t received_ = 0;
  traffic out_, in_;  ///< messages, and items in `bytes`, that go to and come from other ranks
};

}  // namespace pairsum::ranks
