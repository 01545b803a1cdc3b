#include "harness/model/peaks.hpp"

#include <omp.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include "harness/measure/stopwatch.hpp"

namespace pairsum::harness {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif

// By default clang uses half of the widest registers.
#ifdef __clang__
#define PAIRSUM_WIDEST [[clang::min_vector_width(512)]]
#else
#define PAIRSUM_WIDEST
#endif

/// A register as a type for which the compiler has + and *.
template <class R>
struct lanes_of;
template <>
struct lanes_of<double> {
  using type [[gnu::vector_size(register_bytes), gnu::may_alias]] = double;
};
template <>
struct lanes_of<float> {
  using type [[gnu::vector_size(register_bytes), gnu::may_alias]] = float;
};
template <class R>
using lanes = typename lanes_of<R>::type;
template <class R>
constexpr std::size_t lane_count = register_bytes / sizeof(R);

/// Two units with a latency of 4 to 5 cycles want 10 chains; 12 and their two factors still fit into 16 registers.
constexpr std::size_t chains = 12;

/// Three arrays of which no page has been touched.
class untouched {
 public:
  explicit untouched(std::size_t bytes) : bytes_(bytes) {
    memory_ = mmap(nullptr, 3 * bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED)
      throw error("no memory for a bandwidth measurement: " + std::to_string(3 * bytes_ >> 20) + " MiB");
    madvise(memory_, 3 * bytes_, MADV_HUGEPAGE);
  }
  untouched(const untouched&) = delete;
  ~untouched() { munmap(memory_, 3 * bytes_); }

  template <class R>
  R* array(std::size_t k) const {
    return reinterpret_cast<R*>(static_cast<std::byte*>(memory_) + k * bytes_);
  }

 private:
  std::size_t bytes_;
  void* memory_;
};

/// Runs f(thread) on all threads at once; seconds from the common start to the last end.
template <class F>
double timed(int threads, F&& f) {
  double seconds = 0;
#pragma omp parallel num_threads(threads)
  {
    stopwatch clock;
#pragma omp barrier
    clock.lap();
    f(static_cast<std::size_t>(omp_get_thread_num()));
#pragma omp barrier
#pragma omp master
    seconds = clock.lap();
  }
  return seconds;
}

/// The smallest time of f(): at least two runs, and as many as begin before `clock` has reached `until_s`.
template <class F>
double best_of(const stopwatch& clock, double until_s, F&& f) {
  double best = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 2 || clock.seconds() < until_s; ++n) best = std::min(best, f());
  return best;
}

template <class R>
double bandwidth(int threads, std::size_t bytes, double budget_s) {
  const stopwatch clock;
  const untouched memory(bytes);
  R *const a = memory.array<R>(0), *const b = memory.array<R>(1), *const c = memory.array<R>(2);
  // pieces of whole cache lines
  const std::size_t line = 64 / sizeof(R), lines = bytes / 64, pieces = static_cast<std::size_t>(threads);
  const auto begin = [&](std::size_t piece) { return lines * piece / pieces * line; };
  timed(threads, [&](std::size_t k) {
    for (std::size_t i = begin(k); i < begin(k + 1); ++i) a[i] = R(0), b[i] = R(1), c[i] = R(2);
  });
  const double seconds = best_of(clock, budget_s, [&] {
    return timed(threads, [&](std::size_t k) {
      peak_loops::triad(a + begin(k), b + begin(k), c + begin(k), R(3), begin(k + 1) - begin(k));
    });
  });
  return 3 * static_cast<double>(lines * 64) / seconds;
}

/// Multiply-adds on all threads, some 20 ms of them at a time.
template <class R>
class multiply_add_pieces {
 public:
  explicit multiply_add_pieces(int threads) : threads_(threads) {
    constexpr double piece_s = 0.02;
    const auto best = [this] { return std::min(run(), run()); };  // one of them may be held up
    while (best() < piece_s / 2 && steps_ < std::uint64_t{1} << 40) steps_ *= 2;
  }
  /// One piece; its seconds.
  double run() const {
    return timed(threads_, [&](std::size_t) {
      std::vector<R> values(peak_loops::multiply_add_width<R>(), R(1));
      peak_loops::multiply_add(values, R(0.75), R(0.5), steps_);  // it tends to 2
      asm volatile("" : : "r"(values.data()) : "memory");
    });
  }
  double flops() const {
    return 2.0 * static_cast<double>(steps_) * static_cast<double>(peak_loops::multiply_add_width<R>()) * threads_;
  }

 private:
  int threads_;
  std::uint64_t steps_ = 1 << 12;
};

template <class R>
double flops(int threads, double budget_s) {
  const stopwatch clock;
  const multiply_add_pieces<R> pieces(threads);
  return pieces.flops() / best_of(clock, budget_s, [&] { return pieces.run(); });
}

template <class R>
double mean_flops(int threads, double budget_s) {
  const multiply_add_pieces<R> pieces(threads);
  double seconds = 0;
  int n = 0;
  for (; seconds < budget_s; ++n) seconds += pieces.run();
  return n * pieces.flops() / seconds;
}

template <class R>
peak_rates measure(int threads, const peak_limits& limits) {
  return {bandwidth<R>(threads, triad_array_bytes(limits.last_level_cache_bytes), 0.7 * limits.budget_s),
          flops<R>(threads, 0.3 * limits.budget_s)};
}

/// Are pairs of this precision summed in double? Else in float. Throws pairsum::error for another precision, or threads
/// that the loops do not run on.
bool pairs_in_double(const std::string& precision, const team& t) {
  if (t.kind() == runtime::tbb) throw error("peaks are measured on a serial or an OpenMP team, not on oneTBB's");
  check_word("precision", precision,
             std::vector<std::string_view>{precision_name<double>(), precision_name<float>(), mixed_precision});
  return precision == precision_name<double>();
}

}  // namespace

namespace peak_loops {

template <class R>
PAIRSUM_WIDEST void triad(R* a, const R* b, const R* c, R s, std::size_t n) {
  using v = lanes<R>;
  v* const to = reinterpret_cast<v*>(a);
  const v *const x = reinterpret_cast<const v*>(b), *const y = reinterpret_cast<const v*>(c);
  for (std::size_t i = 0; i < n / lane_count<R>; ++i) to[i] = x[i] + s * y[i];
}

template <class R>
std::size_t multiply_add_width() {
  return chains * lane_count<R>;
}

template <class R>
PAIRSUM_WIDEST void multiply_add(std::vector<R>& values, R f, R g, std::uint64_t steps) {
  using v = lanes<R>;
  v x[chains];
  std::memcpy(x, values.data(), sizeof x);
  const v factor = v{} + f, summand = v{} + g;
  for (std::uint64_t n = 0; n < steps; ++n) {
#pragma GCC unroll 12
    for (std::size_t k = 0; k < chains; ++k) x[k] = x[k] * factor + summand;
  }
  std::memcpy(values.data(), x, sizeof x);
}

template void triad(double*, const double*, const double*, double, std::size_t);
template void triad(float*, const float*, const float*, float, std::size_t);
template std::size_t multiply_add_width<double>();
template std::size_t multiply_add_width<float>();
template void multiply_add(std::vector<double>&, double, double, std::uint64_t);
template void multiply_add(std::vector<float>&, float, float, std::uint64_t);

}  // namespace peak_loops

std::size_t triad_array_bytes(std::uint64_t last_level_cache_bytes) {
  constexpr std::uint64_t most = 256u << 20;
  const std::uint64_t wanted = last_level_cache_bytes == 0 ? most : 4 * last_level_cache_bytes;
  return static_cast<std::size_t>(std::min(wanted, most) / 4096 * 4096);
}

peak_rates measure_peaks(const std::string& precision, const team& t, const peak_limits& limits) {
  return pairs_in_double(precision, t) ? measure<double>(t.threads(), limits) : measure<float>(t.threads(), limits);
}

double measure_multiply_adds(const std::string& precision, const team& t, double budget_s) {
  return pairs_in_double(precision, t) ? mean_flops<double>(t.threads(), budget_s)
                                       : mean_flops<float>(t.threads(), budget_s);
}

}  // namespace pairsum::harness
