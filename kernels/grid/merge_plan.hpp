#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include <pairsum/core/column.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/grid/counting_sort.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// A particle that changed its cell: where it lies, and its new key.
struct mover {
  std::uint32_t from, key;
};

/// Restores the order of sorted keys after few of them changed: those that stayed keep their order and shift in place,
/// movers are taken out and put in between. The result is that of a stable sort of everything, to the last particle,
/// for every team; the cost is one pass over what shifts instead of several over all.
class merge_plan {
 public:
  /// keys: ascending, as they were; movers: by ascending `from`, all with keys of fewer than `bits` bits.
  void make(std::span<const std::uint32_t> keys, std::span<const mover> movers, int bits, const team& t);

  /// Carries the plan out for the first keys.size() elements of a column.
  template <class T>
  void apply(column<T>& c, const team& t);
  template <int D, class R>
  void apply(particle_set<D, R>& p, const team& t) {
    p.each_column([&](auto& c) { apply(c, t); });
  }

 private:
  /// Elements [begin, end) that go to `begin + by` ...
  struct run {
    std::uint32_t begin, end;
    std::int64_t by;
  };
  struct jump {
    std::uint32_t from, to;
  };
  /// What one thread does: positions of its piece alone, after all have saved what comes from elsewhere.
  struct piece {
    std::vector<run> runs;    ///< ascending; from the piece into the piece
    std::vector<jump> jumps;  ///< movers, and what crosses from another piece
    std::size_t scratch = 0;  ///< where its jumps are saved
  };
  void add_run(std::uint32_t begin, std::uint32_t end, std::int64_t by);
  std::size_t piece_of(std::size_t position) const;

  std::size_t n_ = 0, saved_ = 0;
  std::vector<piece> pieces_;
  std::vector<std::size_t> ends_;  ///< of the pieces
  counting_sort sort_;
  column<std::uint32_t> mover_keys_, gaps_;
  column<std::byte> scratch_;
};

template <class T>
void merge_plan::apply(column<T>& c, const team& t) {
  scratch_.resize(saved_ * sizeof(T));
  T* const saved = reinterpret_cast<T*>(scratch_.data());
  T* const a = c.data();
  t.for_each(pieces_.size(), [&](std::size_t p) {
    T* to = saved + pieces_[p].scratch;
    for (const jump& j : pieces_[p].jumps) *to++ = a[j.from];
  });
  // Nothing is overwritten before it is read: what goes left is taken from the left, what goes right from the right.
  t.for_each(pieces_.size(), [&](std::size_t p) {
    const auto& runs = pieces_[p].runs;
    for (const run& r : runs)
      if (r.by < 0) std::copy(a + r.begin, a + r.end, a + (r.begin + r.by));
    for (auto r = runs.rbegin(); r != runs.rend(); ++r)
      if (r->by > 0) std::copy_backward(a + r->begin, a + r->end, a + (r->end + r->by));
    const T* from = saved + pieces_[p].scratch;
    for (const jump& j : pieces_[p].jumps) a[j.to] = *from++;
  });
}

}  // namespace pairsum
