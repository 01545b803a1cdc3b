#include <pairsum/grid/counting_sort.hpp>

#include <algorithm>
#include <utility>

namespace pairsum {

void counting_sort::sort(std::span<const std::uint32_t> keys, int bits, const team& t) {
  const std::size_t n = keys.size();
  a_.resize(n);
  b_.resize(n);
  order_.resize(n);
  t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) a_[k] = {keys[k], static_cast<std::uint32_t>(k)};
  });
  const int passes = std::max(1, (bits + digit_bits - 1) / digit_bits);
  const int width = std::max(1, (bits + passes - 1) / passes);
  item *from = a_.data(), *to = b_.data();
  for (int p = 0; p < passes; ++p) {
    pass(from, to, n, p * width, width, t);
    std::swap(from, to);
  }
  t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) order_[k] = from[k].index;
  });
}

void counting_sort::pass(const item* from, item* to, std::size_t n, int shift, int bits, const team& t) {
  const std::size_t buckets = std::size_t{1} << bits, pieces = static_cast<std::size_t>(t.threads());
  const std::uint32_t mask = static_cast<std::uint32_t>(buckets - 1);
  counts_.assign(buckets * pieces, 0);
  t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t piece) {
    std::uint32_t* const count = counts_.data() + piece * buckets;
    for (std::size_t k = begin; k < end; ++k) ++count[from[k].key >> shift & mask];
  });
  // Where each piece writes each bucket: buckets ascending, and inside a bucket the pieces in order, which keeps it
  // stable.
  std::uint32_t position = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket)
    for (std::size_t piece = 0; piece < pieces; ++piece)
      position += std::exchange(counts_[piece * buckets + bucket], position);
  t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t piece) {
    std::uint32_t* const next = counts_.data() + piece * buckets;
    for (std::size_t k = begin; k < end; ++k) to[next[from[k].key >> shift & mask]++] = from[k];
  });
}

}  // namespace pairsum
