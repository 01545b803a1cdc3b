#pragma once
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include <pairsum/core/column.hpp>
#include <pairsum/core/vec.hpp>

/// A few quantities (what a particle brings to a pair, what a pair gives back) kept as one column per scalar: either a
/// struct that lists its fields once, in `static constexpr auto fields()`, a tuple of member pointers to scalars or
/// vecs; or a single scalar or vec. Columns, loads, stores and sums are derived from that at compile time.
namespace pairsum {

namespace fields_detail {

template <class F>
struct field {
  static constexpr int width = 1;
  using scalar = F;
  static F& at(F& f, int) { return f; }
  static const F& at(const F& f, int) { return f; }
};
template <class T, int D, int O>
struct field<Eigen::Matrix<T, D, 1, O>> {
  static constexpr int width = D;
  using scalar = T;
  static T& at(Eigen::Matrix<T, D, 1, O>& f, int d) { return f[d]; }
  static const T& at(const Eigen::Matrix<T, D, 1, O>& f, int d) { return f[d]; }
};

template <class P>
struct member;
template <class S, class F>
struct member<F S::*> {
  using type = field<F>;
};

template <class S>
concept is_struct = requires {
  S::fields();
};

template <class S, class F>
[[gnu::always_inline]] inline void each_member(F&& f) {
  constexpr auto list = S::fields();
  [&]<std::size_t... K>(std::index_sequence<K...>) { (f(std::get<K>(list)), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(list)>>{});
}

template <class S>
constexpr int count() {
  if constexpr (is_struct<S>)
    return []<class... P>(std::tuple<P...>) { return (member<P>::type::width + ... + 0); }(S::fields());
  else
    return field<S>::width;
}

}  // namespace fields_detail

/// Number of scalars in S, and so of columns.
template <class S>
inline constexpr int field_count = fields_detail::count<S>();

/// The first slot of a field that S lists.
template <class S, class F>
int field_slot(F S::*wanted) {
  int slot = 0, found = -1;
  fields_detail::each_member<S>([&](auto p) {
    if constexpr (std::is_same_v<decltype(p), F S::*>)
      if (p == wanted) found = slot;
    slot += fields_detail::member<decltype(p)>::type::width;
  });
  return found;
}

/// Calls f(scalar, slot) on every scalar of s, slots counting from 0 in the order of the fields.
template <class S, class F>
[[gnu::always_inline]] inline void each_scalar(S&& s, F&& f) {
  using plain = std::remove_cvref_t<S>;
  int slot = 0;
  if constexpr (fields_detail::is_struct<plain>) {
    fields_detail::each_member<plain>([&](auto p) __attribute__((always_inline)) {
      using field = typename fields_detail::member<decltype(p)>::type;
      for (int d = 0; d < field::width; ++d) f(field::at(s.*p, d), slot++);
    });
  } else {
    using field = fields_detail::field<plain>;
    for (; slot < field::width; ++slot) f(field::at(s, slot), slot);
  }
}

/// A struct of zeros.
template <class S>
[[gnu::always_inline]] inline S zero() {
  S s;
  each_scalar(
      s, [](auto& a, int) __attribute__((always_inline)) { a = std::remove_reference_t<decltype(a)>(0); });
  return s;
}

/// a += b, field by field.
template <class S>
[[gnu::always_inline]] inline void add(S& a, const S& b) {
  if constexpr (fields_detail::is_struct<S>)
    fields_detail::each_member<S>([&](auto p) __attribute__((always_inline)) { a.*p += b.*p; });
  else
    a += b;
}

/// Where the columns of S begin; element i of every column together is the struct of particle i.
template <class S>
struct field_pointers {
  std::array<void*, field_count<S>> begin{};

  template <class T>
  T* column_as(int slot) const {
    return static_cast<T*>(begin[slot]);
  }
  [[gnu::always_inline]] S load(std::size_t i) const {
    S s;
    each_scalar(
        s, [&](auto& a, int slot)
               __attribute__((always_inline)) { a = column_as<std::remove_reference_t<decltype(a)>>(slot)[i]; });
    return s;
  }
  [[gnu::always_inline]] void store(std::size_t i, const S& s) const {
    each_scalar(
        s, [&](const auto& a, int slot)
               __attribute__((always_inline)) { column_as<std::remove_cvref_t<decltype(a)>>(slot)[i] = a; });
  }
  [[gnu::always_inline]] void add(std::size_t i, const S& s) const {
    each_scalar(
        s, [&](const auto& a, int slot)
               __attribute__((always_inline)) { column_as<std::remove_cvref_t<decltype(a)>>(slot)[i] += a; });
  }
};

/// Owns the columns of S.
template <class S>
class field_columns {
 public:
  void resize(std::size_t n) {
    each_scalar(zero<S>(), [&](const auto& a, int slot) { data_[slot].resize(n * sizeof a); });
  }
  field_pointers<S> pointers() {
    field_pointers<S> p;
    for (int slot = 0; slot < field_count<S>; ++slot) p.begin[slot] = data_[slot].data();
    return p;
  }

 private:
  std::array<column<std::byte>, field_count<S>> data_;
};

}  // namespace pairsum
