#include "harness/model/rank_cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>

namespace pairsum::harness {
namespace {

constexpr double rounding = 1e-12;

void check_number(const char* what, double a, bool zero_is_valid) {
  if (!std::isfinite(a) || a < 0 || (a == 0 && !zero_is_valid))
    throw error(std::string(what) + " should be finite and " + (zero_is_valid ? "not negative" : "positive") + ", is " +
                number_text(a));
}

void check_box(const lattice_box& box) {
  check_number("dx", box.dx, false);
  check_number("H", box.H, false);
  check_number("the skin", box.skin, true);
  for (std::size_t d = 0; d < 3; ++d) {
    check_number("a rank's number of particles along an axis", box.particles[d], false);
    check_number("the number of ranks along an axis", box.ranks[d], false);
    const double edge = box.dx * box.particles[d] * box.ranks[d];
    if (edge < 3 * box.H * (1 - rounding))
      throw error("a periodic domain is at least 3 H wide, " + number_text(3 * box.H) + " m, this one " +
                  number_text(edge) + " m");
  }
}

/// Own particles, ghosts and neighbours of a box whose halo is `reach` particles wide.
rank_share with_halo(const lattice_box& box, double reach) {
  rank_share s;
  double all = 1, ranks = 1;
  s.own = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const double n = box.particles[d], p = box.ranks[d];
    s.own *= n;
    all *= std::min(p * n, n + 2 * reach);  // around a narrow domain both faces' halos are the same particles
    ranks *= std::min(p, 1 + 2 * std::ceil(reach / n - rounding));
  }
  s.ghosts = all - s.own;
  s.neighbours = ranks - 1;
  return s;
}

}  // namespace

rank_share counted_share(const lattice_box& box) {
  check_box(box);
  const double reach = box.H / box.dx, halo = reach + box.skin / box.dx;
  rank_share s = with_halo(box, std::floor((halo + 0.5) * (1 + rounding)));
  const int far = static_cast<int>(reach);
  const auto stay = [&](std::size_t d, int o) {
    const double n = box.particles[d];
    return box.ranks[d] == 1 ? n : std::max(0.0, n - std::abs(o));
  };
  for (int x = -far; x <= far; ++x)
    for (int y = -far; y <= far; ++y)
      for (int z = -far; z <= far; ++z) {
        const double r2 = double(x) * x + double(y) * y + double(z) * z;
        if (r2 == 0 || r2 >= reach * reach * (1 - rounding)) continue;
        const double kept = stay(0, x) * stay(1, y) * stay(2, z);
        s.inner += kept / 2;  // o and -o are one pair
        s.cut += s.own - kept;
      }
  return s;
}

rank_share mean_share(const lattice_box& box) {
  check_box(box);
  const double reach = box.H / box.dx;
  rank_share s = with_halo(box, reach + box.skin / box.dx);
  std::array<double, 3> a{};  // H over the box's edge, 0 along axes that are not cut
  for (std::size_t d = 0; d < 3; ++d) {
    if (box.ranks[d] == 1) continue;
    a[d] = reach / box.particles[d];
    if (a[d] > 1 + rounding)
      throw error("the mean holds for a rank's box at least H wide, " + number_text(box.H) + " m, this one is " +
                  number_text(box.dx * box.particles[d]) + " m wide");
  }
  using std::numbers::pi;
  const double kept = 1 - 3.0 / 8 * (a[0] + a[1] + a[2]) + 2 / (5 * pi) * (a[0] * a[1] + a[1] * a[2] + a[2] * a[0]) -
                      1 / (8 * pi) * a[0] * a[1] * a[2];
  const double partners = 4 * pi / 3 * reach * reach * reach;
  s.inner = s.own * partners * kept / 2;
  s.cut = s.own * partners * (1 - kept);
  return s;
}

rank_traffic traffic_of(const rank_share& rank, const ghost_bytes& bytes, cut_mode mode) {
  const bool back = mode == cut_mode::once;
  return {rank.neighbours * (back ? 2 : 1), rank.ghosts * (bytes.particle + (back ? bytes.rates : 0))};
}

double pairs_summed(const rank_share& rank, cut_mode mode) {
  return rank.inner + rank.cut / (mode == cut_mode::once ? 2 : 1);
}

double evaluation_s(std::span<const rank_share> ranks, const unit_costs& costs, const ghost_bytes& bytes,
                    const link_rates& link, cut_mode mode) {
  if (ranks.empty()) throw error("the time of an evaluation needs at least one rank, there are none");
  check_number("the time of a particle", costs.s_per_particle, true);
  check_number("the time of a pair", costs.s_per_pair, true);
  check_number("a ghost's record", bytes.particle, true);
  check_number("a ghost's rates", bytes.rates, true);
  check_number("the latency", link.latency_s, true);
  check_number("the bandwidth", link.bandwidth_bytes_per_s, false);
  double work = 0, messages = 0;
  for (const rank_share& r : ranks) {
    const rank_traffic t = traffic_of(r, bytes, mode);
    work = std::max(work, costs.s_per_particle * (r.own + r.ghosts) + costs.s_per_pair * pairs_summed(r, mode));
    messages = std::max(messages, t.messages * link.latency_s + t.bytes / link.bandwidth_bytes_per_s);
  }
  return work + messages;
}

}  // namespace pairsum::harness
