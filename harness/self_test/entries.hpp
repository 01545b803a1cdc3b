#pragma once
#include <optional>
#include <span>
#include <string_view>

namespace pairsum::harness {

/// What was done to a copy of a backend.
enum class self_test_kind {
  again,   ///< nothing
  slowed,  ///< each sum takes a known share longer
  corrupt  ///< one rate is wrong
};

/// A backend whose behaviour against its base is known beforehand.
struct self_test_entry {
  std::string_view word, base;  ///< own name, and that of the backend it copies
  self_test_kind kind;
  double delay;           ///< added to the summation phase, as a share of it
  std::string_view what;  ///< for tables
  std::string_view description;

  /// Summation time over that of the base; none where verification must refuse the point.
  constexpr std::optional<double> expected_ratio() const {
    if (kind == self_test_kind::corrupt) return std::nullopt;
    return 1 + delay;
  }
};

namespace detail {

using enum self_test_kind;
inline constexpr self_test_entry self_test_table[] = {
    {"again_symmetric_omp", "symmetric_omp", again, 0, "A/A", "self-test: symmetric_omp under another name"},
    {"slowed_5_symmetric_omp", "symmetric_omp", slowed, 0.05, "slowed 5 %",
     "self-test: symmetric_omp, then a busy wait of 5 % of its summation's time"},
    {"slowed_20_symmetric_omp", "symmetric_omp", slowed, 0.2, "slowed 20 %",
     "self-test: symmetric_omp, then a busy wait of 20 % of its summation's time"},
    {"corrupt_symmetric_omp", "symmetric_omp", corrupt, 0, "corrupt",
     "self-test: symmetric_omp with one wrong rate of one particle"},
    {"again_naive_omp", "naive_omp", again, 0, "A/A", "self-test: naive_omp under another name"},
    {"slowed_5_naive_omp", "naive_omp", slowed, 0.05, "slowed 5 %",
     "self-test: naive_omp, then a busy wait of 5 % of its summation's time"},
    {"slowed_20_naive_omp", "naive_omp", slowed, 0.2, "slowed 20 %",
     "self-test: naive_omp, then a busy wait of 20 % of its summation's time"},
    {"corrupt_naive_omp", "naive_omp", corrupt, 0, "corrupt",
     "self-test: naive_omp with one wrong rate of one particle"},
};

}  // namespace detail

/// All of them, whether or not their bases were built.
constexpr std::span<const self_test_entry> self_test_entries() { return detail::self_test_table; }

}  // namespace pairsum::harness
