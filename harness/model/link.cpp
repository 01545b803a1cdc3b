#include "harness/model/link.hpp"

#include <cmath>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/measure/stopwatch.hpp"
#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

/// The median time of one way, s.
double one_way(const bounce_times& t) {
  const std::string of = "messages of " + std::to_string(t.bytes) + " bytes ";
  if (t.seconds.empty()) throw error(of + "were not timed: a link needs at least one time of each size");
  for (const double s : t.seconds)
    if (!(s > 0 && std::isfinite(s)))
      throw error(of + "took " + number_text(s) + " s; times should be positive and finite");
  return median(t.seconds) / 2;
}

}  // namespace

link_rates fit_link(const bounce_times& small, const bounce_times& large) {
  const double s = one_way(small), l = one_way(large);
  const std::string sizes = std::to_string(large.bytes) + " bytes and " + std::to_string(small.bytes);
  if (large.bytes <= small.bytes) throw error("a link needs a large message and a small one, not " + sizes);
  if (l <= s)
    throw error("messages of " + sizes + " took " + number_text(l) + " s and " + number_text(s) +
                ": no bandwidth follows; larger ones should take longer");
  link_rates rates;
  rates.bandwidth_bytes_per_s = static_cast<double>(large.bytes - small.bytes) / (l - s);
  rates.latency_s = s - static_cast<double>(small.bytes) / rates.bandwidth_bytes_per_s;
  if (!(rates.latency_s > 0))
    throw error("messages of " + sizes + " took " + number_text(l) + " s and " + number_text(s) +
                ": no latency is left; the small ones should be smaller");
  return rates;
}

bounce_times time_bounces(const bouncer& bounce, std::size_t bytes, int repetitions, int warm_up) {
  std::vector<std::byte> message(bytes);
  for (int k = 0; k < warm_up; ++k) bounce(message);
  bounce_times times{bytes, {}};
  times.seconds.reserve(static_cast<std::size_t>(repetitions));
  stopwatch watch;
  for (int k = 0; k < repetitions; ++k) {
    bounce(message);
    times.seconds.push_back(watch.lap());
  }
  return times;
}

link_rates measure_link(const bouncer& bounce, bool timed, const link_limits& limits) {
  const bounce_times small = time_bounces(bounce, limits.small_bytes, limits.small_repetitions, limits.warm_up);
  const bounce_times large = time_bounces(bounce, limits.large_bytes, limits.large_repetitions, limits.warm_up);
  return timed ? fit_link(small, large) : link_rates{};
}

}  // namespace pairsum::harness
