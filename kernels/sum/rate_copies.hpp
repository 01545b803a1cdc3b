#pragma once
#include <algorithm>
#include <vector>

#include <pairsum/core/column.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/sum/problem.hpp>

namespace pairsum {

/// Columns of rates, whatever they are.
class rate_copy {
 public:
  /// Undefined until zeroed.
  void resize(std::span<const std::uint16_t> bytes, std::size_t particles) {
    columns_.resize(bytes.size());
    begin_.resize(bytes.size());
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      columns_[k].resize(bytes[k] * particles);
      begin_[k] = columns_[k].data();
    }
    stride_ = bytes.empty() ? 0 : bytes[0];
  }
  rate_view view() const { return {begin_.data(), stride_}; }

 private:
  std::vector<column<std::byte>> columns_;
  std::vector<void*> begin_;
  std::size_t stride_ = 0;
};

/// Private copies of the rates for threads or passes, reduced in a fixed order. Copy 0 is the rates
/// themselves.
template <int D, class R>
class rate_copies {
 public:
  void resize(std::size_t copies, const problem<D, R>& p) {
    rest_.resize(copies > 0 ? copies - 1 : 0);
    for (rate_copy& copy : rest_) copy.resize(p.pairs->rate_bytes, p.rate_rows());
  }
  std::size_t size() const { return rest_.size() + 1; }
  rate_view of(const problem<D, R>& p, std::size_t k) const { return k == 0 ? p.u : rest_[k - 1].view(); }

  /// Adds all copies to the rates, each particle's in the order of the copies.
  void join(const problem<D, R>& p, const team& t) const {
    constexpr std::size_t piece = 1024;  // of a column, which stays in the first-level cache meanwhile
    t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (; begin < end; begin += piece)
        for (const rate_copy& copy : rest_) p.pairs->add(p.u, begin, copy.view(), begin, std::min(piece, end - begin));
    });
  }

 private:
  std::vector<rate_copy> rest_;
};

}  // namespace pairsum
