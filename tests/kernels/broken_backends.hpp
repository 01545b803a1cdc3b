#pragma once
#include <cmath>
#include <cstring>
#include <string_view>

#include <pairsum/schedule/base_blocks.hpp>
#include <pairsum/sum/rate_copies.hpp>

// Backends that are wrong in one pair, to show that verification rejects them: the talk's passes, serial and scalar,
// with a fault planted in the first fluid pair they meet whose contribution to j is not zero.
namespace pairsum {

enum class fault {
  none,         ///< correct: must pass
  drop_pair,    ///< the pair is left out
  double_pair,  ///< the pair is summed twice
  flip_sign,    ///< the contribution to j has the wrong sign
};

constexpr std::string_view name_of(fault f) {
  return f == fault::none          ? "broken_none"
         : f == fault::drop_pair   ? "broken_drop_pair"
         : f == fault::double_pair ? "broken_double_pair"
                                   : "broken_flip_sign";
}

/// A formula's functions, of which `both` has a fault.
template <fault F, int D, class R>
class faulty_sums : public pair_sum<D, R> {
 public:
  explicit faulty_sums(const problem<D, R>& p) : pair_sum<D, R>(*p.pairs), right_(*p.pairs) {
    one_pair_.resize(p.pairs->rate_bytes, p.fluid_count);
    this->both[plain] = [](const void* call, const row* rows, std::size_t n) {
      const auto& c = *static_cast<const sum_call<D, R>*>(call);
      auto& self = const_cast<faulty_sums&>(static_cast<const faulty_sums&>(*c.p.pairs));
      for (std::size_t k = 0; k < n; ++k) self.sum_row(c, rows[k]);
    };
  }

 private:
  static constexpr auto plain = static_cast<unsigned>(update::plain);

  void sum_row(const sum_call<D, R>& c, row r) {
    for (; r.fluid_count > 0 && !planted_; ++r.fluid, --r.fluid_count) sum_pair(c, r.i, r.fluid);
    right_.both[plain](&c, &r, 1);
  }
  void sum_pair(const sum_call<D, R>& c, std::uint32_t i, const std::uint32_t* j) {
    const rate_view u = one_pair_.view();
    for (const std::uint32_t k : {i, *j}) right_.zero(u, k, k + 1);
    const row pair{j, j + 1, 1, 0, i};
    const target apart{.u = u};
    const sum_call<D, R> call{c.p, apart};
    right_.both[plain](&call, &pair, 1);
    int times = 1;
    if (acts_on(*j)) {
      planted_ = true;
      if (F == fault::flip_sign) flip(*j);
      times = F == fault::drop_pair ? 0 : F == fault::double_pair ? 2 : 1;
    }
    for (int n = 0; n < times; ++n)
      for (const std::uint32_t k : {i, *j}) right_.add(c.to.u, k, u, k, 1);
  }

  /// Calls f(bytes of a rate, how many) for each rate of j.
  template <class Each>
  void each_rate(std::uint32_t j, Each&& f) {
    for (std::size_t k = 0; k < right_.rate_bytes.size(); ++k)
      f(static_cast<std::byte*>(one_pair_.view().begin[k]) + std::size_t{j} * right_.rate_bytes[k],
        right_.rate_bytes[k]);
  }
  bool acts_on(std::uint32_t j) {
    bool any = false;
    each_rate(j, [&](const std::byte* a, std::size_t bytes) {
      for (std::size_t b = 0; b < bytes; ++b) any = any || a[b] != std::byte{0};
    });
    return any;
  }
  void flip(std::uint32_t j) {
    each_rate(j, [](std::byte* a, std::size_t) {
      R number;
      std::memcpy(&number, a, sizeof number);
      if (std::fpclassify(number) != FP_SUBNORMAL) {
        number = -number;
        std::memcpy(a, &number, sizeof number);
      } else {  // read as it is: a whole number
        std::uint64_t whole;
        std::memcpy(&whole, a, sizeof whole);
        whole = 0 - whole;
        std::memcpy(a, &whole, sizeof whole);
      }
    });
  }

  const pair_sum<D, R>& right_;
  rate_copy one_pair_;
  bool planted_ = F == fault::none;
};

template <fault F, int D, class R>
class broken_passes : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits = [] {
    backend_traits t = base_blocks<D, R>::traits;
    t.description = "for tests: wrong in one pair";
    t.aliases = "";
    return t;
  }();

  void prepare(const P& p, const team& t) override { right_.prepare(p, t); }
  unsigned colours(const P& p) const override { return right_.colours(p); }
  std::size_t size(const P& p, unsigned colour) const override { return right_.size(p, colour); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override { right_.unit(p, colour, k, thread); }
  void sum(const P& p, const team& t, const backend_traits& own, const pass_marks& marks) override {
    if (p.counts != nullptr) return right_.sum(p, t, own, marks);  // without a formula
    const faulty_sums<F, D, R> wrong(p);
    P with_fault = p;
    if (F != fault::none) with_fault.pairs = &wrong;
    right_.sum(with_fault, t, own, marks);
  }

 private:
  base_blocks<D, R> right_;
};

template <int D, class R>
using broken_none = broken_passes<fault::none, D, R>;
template <int D, class R>
using broken_drop_pair = broken_passes<fault::drop_pair, D, R>;
template <int D, class R>
using broken_double_pair = broken_passes<fault::double_pair, D, R>;
template <int D, class R>
using broken_flip_sign = broken_passes<fault::flip_sign, D, R>;

/// All of them, the sound one first.
inline std::vector<backend_entry> broken_backends() {
  return {backend_entry::of<broken_none>(name_of(fault::none), runtime::serial),
          backend_entry::of<broken_drop_pair>(name_of(fault::drop_pair), runtime::serial),
          backend_entry::of<broken_double_pair>(name_of(fault::double_pair), runtime::serial),
          backend_entry::of<broken_flip_sign>(name_of(fault::flip_sign), runtime::serial)};
}

}  // namespace pairsum
