#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/core/zero_table.hpp>

namespace pairsum {

/// Finds the cell of a key, 0 if it is empty, in a table over all keys. Only pages that are used take memory, and a
/// change costs only the cells that hold particles.
class cell_table {
 public:
  cell_table() = default;
  explicit cell_table(zero_table t) : table_(std::move(t)) {}

  std::size_t size() const { return table_.size(); }
  const std::uint32_t* data() const { return table_.data(); }

  /// From now on cell c is that of key cell_keys[c]; entry 0 is unused.
  void set(std::span<const std::uint32_t> cell_keys, const team& t) {
    mark(known_, false, t);
    known_.assign(cell_keys.begin(), cell_keys.end());
    mark(known_, true, t);
  }

 private:
  void mark(std::span<const std::uint32_t> keys, bool present, const team& t) {
    t.for_pieces(keys.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t c = std::max<std::size_t>(begin, 1); c < end; ++c)
        table_.data()[keys[c]] = present ? static_cast<std::uint32_t>(c) : 0;
    });
  }

  zero_table table_;
  std::vector<std::uint32_t> known_;  ///< keys set in the table
};

}  // namespace pairsum
