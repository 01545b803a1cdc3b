#pragma once
#include <Eigen/Core>
#include <cmath>
#include <type_traits>
#include <vector>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// The operations that a formula made, so that those needed for some of its results can be counted: what a compiler
/// keeps when it removes dead code.
class flop_tape {
 public:
  /// A new operation of so many flops on the results of earlier ones (-1: none); returns its number.
  int record(int flops, int a = -1, int b = -1, int c = -1) {
    steps_.push_back({flops, {a, b, c}});
    return static_cast<int>(steps_.size()) - 1;
  }
  /// Marks an operation as wanted, with all it needs.
  void want(int step) {
    if (step < 0 || steps_[static_cast<std::size_t>(step)].wanted) return;
    auto& s = steps_[static_cast<std::size_t>(step)];
    s.wanted = true;
    for (const int operand : s.operands) want(operand);
  }
  /// Flops of the wanted operations; starts over with none wanted.
  int take() {
    int flops = 0;
    for (auto& s : steps_) {
      flops += s.wanted ? s.flops : 0;
      s.wanted = false;
    }
    return flops;
  }

 private:
  struct step {
    int flops;
    int operands[3];
    bool wanted = false;
  };
  std::vector<step> steps_;
};

/// A value of which a tape knows how it came about; a constant has none. + - * / square_root, maximum, absolute,
/// comparison, select, exponential are 1 flop each, fused 2, a change of sign none. What compilers fold is no
/// operation: between constants, times a constant 1, plus or minus a constant 0.
struct counted {
  double v = 0;
  flop_tape* tape = nullptr;
  int step = -1;

  counted() = default;
  template <class N>
  requires std::is_arithmetic_v<N> counted(N value) : v(static_cast<double>(value)) {}  // NOLINT: constants convert
  counted(double value, flop_tape* t, int s) : v(value), tape(t), step(s) {}

  static counted input(flop_tape& t, double value) { return {value, &t, t.record(0)}; }
  bool is(double constant) const { return !tape && v == constant; }

  static counted of(int flops, double value, const counted& a, const counted& b, const counted& c) {
    flop_tape* const t = a.tape ? a.tape : b.tape ? b.tape : c.tape;
    return t ? counted(value, t, t->record(flops, a.step, b.step, c.step)) : counted(value);
  }
  static counted of(int flops, double value, const counted& a, const counted& b) {
    return of(flops, value, a, b, counted());
  }
  static counted of(int flops, double value, const counted& a) { return of(flops, value, a, counted(), counted()); }

  friend counted operator+(const counted& a, const counted& b) {
    return a.is(0) ? b : b.is(0) ? a : of(1, a.v + b.v, a, b);
  }
  friend counted operator-(const counted& a, const counted& b) {
    return a.is(0) ? -b : b.is(0) ? a : of(1, a.v - b.v, a, b);
  }
  friend counted operator*(const counted& a, const counted& b) {
    return a.is(1) ? b : b.is(1) ? a : of(1, a.v * b.v, a, b);
  }
  friend counted operator/(const counted& a, const counted& b) { return b.is(1) ? a : of(1, a.v / b.v, a, b); }
  counted operator-() const { return of(0, -v, *this); }
  counted& operator+=(const counted& b) { return *this = *this + b; }
  counted& operator-=(const counted& b) { return *this = *this - b; }
  counted& operator*=(const counted& b) { return *this = *this * b; }
  counted& operator/=(const counted& b) { return *this = *this / b; }

  struct mask;
  friend mask operator<(const counted& a, const counted& b);
  friend mask operator==(const counted& a, const counted& b);

  friend counted square_root(const counted& a) { return of(1, std::sqrt(a.v), a); }
  friend counted exponential(const counted& a) { return of(1, std::exp(a.v), a); }
  friend counted maximum(const counted& a, const counted& b) { return of(1, a.v < b.v ? b.v : a.v, a, b); }
  friend counted absolute(const counted& a) { return of(1, std::abs(a.v), a); }
  friend counted fused(const counted& a, const counted& b, const counted& c) { return of(2, a.v * b.v + c.v, a, b, c); }
};

/// A comparison's outcome: a formula that branches on it is counted along the branch it takes.
struct counted::mask {
  counted outcome;
  operator bool() const { return outcome.v != 0; }  // NOLINT: used like a bool
};
inline counted::mask operator<(const counted& a, const counted& b) { return {counted::of(1, a.v < b.v, a, b)}; }
inline counted::mask operator==(const counted& a, const counted& b) { return {counted::of(1, a.v == b.v, a, b)}; }
inline counted select(const counted::mask& m, const counted& a, const counted& b) {
  return counted::of(1, m ? a.v : b.v, m.outcome, a, b);
}

}  // namespace pairsum

namespace Eigen {
template <>
struct NumTraits<pairsum::counted> : NumTraits<double> {
  using Real = pairsum::counted;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen
