#include "harness/model/rank_cost.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "scene.hpp"

namespace pairsum::harness {
namespace {

using test_kit::error_of;
using test_kit::says;

std::string text(const lattice_box& b) {
  std::ostringstream o;
  o << b.particles[0] << "x" << b.particles[1] << "x" << b.particles[2] << " on " << b.ranks[0] << "x" << b.ranks[1]
    << "x" << b.ranks[2] << ", H = " << b.H / b.dx << " dx, skin " << b.skin / b.dx << " dx";
  return o.str();
}

/// The share of rank (0, 0, 0), particle by particle: all others of the domain with the nearest image of each.
rank_share by_brute_force(const lattice_box& b) {
  std::array<int, 3> all{};
  for (std::size_t d = 0; d < 3; ++d) all[d] = b.particles[d] * b.ranks[d];
  rank_share s;
  std::set<std::array<int, 3>> others;
  std::array<int, 3> at{};
  for (at[0] = 0; at[0] < all[0]; ++at[0])
    for (at[1] = 0; at[1] < all[1]; ++at[1])
      for (at[2] = 0; at[2] < all[2]; ++at[2]) {
        std::array<int, 3> rank{};
        bool near = true;
        for (std::size_t d = 0; d < 3; ++d) {
          rank[d] = at[d] / b.particles[d];
          // From the particle's centre to the nearer face, around the domain.
          const double x = at[d] + 0.5, n = b.particles[d];
          near = near && (x < n || std::min(x - n, all[d] - x) * b.dx <= b.H + b.skin);
        }
        const bool own = rank == std::array<int, 3>{};
        if (own) ++s.own;
        if (!own && near) {
          ++s.ghosts;
          others.insert(rank);
        }
        for (int k = 0; k < b.particles[0] * b.particles[1] * b.particles[2]; ++k) {
          const std::array<int, 3> i{k % b.particles[0], k / b.particles[0] % b.particles[1],
                                     k / b.particles[0] / b.particles[1]};
          double r2 = 0;
          for (std::size_t d = 0; d < 3; ++d) {
            const int apart = std::abs(i[d] - at[d]);
            r2 += std::pow(b.dx * std::min(apart, all[d] - apart), 2);
          }
          if (r2 == 0 || r2 >= b.H * b.H) continue;
          (own ? s.inner : s.cut) += own ? 0.5 : 1;
        }
      }
  s.neighbours = static_cast<double>(others.size());
  return s;
}

TEST(rank_cost, of_a_lattice_is_what_counting_finds) {
  for (const lattice_box& b : std::vector<lattice_box>{{{4, 4, 4}, {3, 3, 3}, 1, 2.1},
                                                       {{4, 4, 4}, {3, 3, 3}, 0.25, 0.65},
                                                       {{3, 3, 3}, {4, 4, 4}, 1, 3.7},
                                                       {{6, 6, 6}, {2, 2, 2}, 1, 2.1},
                                                       {{4, 4, 4}, {2, 2, 2}, 1, 2.6},
                                                       {{4, 8, 8}, {3, 1, 1}, 1, 2.1},
                                                       {{4, 5, 7}, {3, 2, 1}, 1, 2.1},
                                                       {{8, 8, 8}, {1, 1, 1}, 1, 2.6},
                                                       {{2, 2, 2}, {5, 5, 5}, 1, 2.6},
                                                       {{4, 4, 4}, {3, 3, 3}, 1, 2.1, 0.6},
                                                       {{5, 5, 4}, {2, 3, 1}, 0.5, 0.6, 0.2}}) {
    SCOPED_TRACE(text(b));
    const rank_share counted = by_brute_force(b), s = counted_share(b);
    EXPECT_EQ(s.own, counted.own);
    EXPECT_EQ(s.ghosts, counted.ghosts);
    EXPECT_EQ(s.inner, counted.inner);
    EXPECT_EQ(s.cut, counted.cut);
    EXPECT_EQ(s.neighbours, counted.neighbours);
  }
}

TEST(rank_cost, neighbours_of_a_box_cut_along_one_two_and_three_axes) {
  const std::array<int, 3> n{8, 8, 8};
  EXPECT_EQ(counted_share({n, {4, 1, 1}, 1, 2}).neighbours, 2);
  EXPECT_EQ(counted_share({n, {4, 4, 1}, 1, 2}).neighbours, 8);
  EXPECT_EQ(counted_share({n, {4, 4, 4}, 1, 2}).neighbours, 26);
  EXPECT_EQ(counted_share({n, {2, 2, 2}, 1, 2}).neighbours, 7) << "each on two sides";
  EXPECT_EQ(counted_share({{2, 9, 9}, {8, 1, 1}, 1, 3}).neighbours, 4) << "the halo is wider than a box";
}

/// Random pairs within H, the first of each in the rank's box.
TEST(rank_cost, mean_is_that_of_random_particles) {
  std::mt19937_64 random(2009);
  const int pairs = 400000;
  for (const lattice_box& b :
       std::vector<lattice_box>{{{4, 4, 4}, {3, 3, 3}, 1, 3.5}, {{8, 6, 12}, {3, 2, 1}, 1, 3.5}}) {
    SCOPED_TRACE(text(b));
    std::uniform_real_distribution<double> anywhere(0, 1);
    int cut = 0;
    for (int k = 0; k < pairs; ++k) {
      std::array<double, 3> r{};
      do
        for (double& c : r) c = b.H * (2 * anywhere(random) - 1);
      while (std::hypot(r[0], r[1], r[2]) > b.H);
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) {
        const double to = b.dx * b.particles[d] * anywhere(random) + r[d];
        inside = inside && (b.ranks[d] == 1 || (to >= 0 && to < b.dx * b.particles[d]));
      }
      cut += !inside;
    }
    const rank_share s = mean_share(b);
    const double share = s.cut / (s.cut + 2 * s.inner);
    EXPECT_NEAR(share, static_cast<double>(cut) / pairs, 5 * std::sqrt(share * (1 - share) / pairs));
    EXPECT_NEAR((s.cut + 2 * s.inner) / s.own, 4.0 / 3 * std::acos(-1.0) * 3.5 * 3.5 * 3.5, 1e-9);
  }
}

/// The mean is what a lattice tends to with more particles within H.
TEST(rank_cost, mean_is_the_limit_of_a_fine_lattice) {
  double error_before = 1;
  for (const int fine : {1, 2, 4}) {
    const lattice_box b{{10 * fine, 10 * fine, 10 * fine}, {3, 3, 3}, 1, 2.5 * fine};
    const rank_share lattice = counted_share(b), mean = mean_share(b);
    const double relative = std::abs(lattice.cut / mean.cut - 1);
    EXPECT_LT(relative, error_before);
    error_before = relative;
    EXPECT_EQ(lattice.neighbours, mean.neighbours);
  }
  EXPECT_LT(error_before, 0.03);
}

/// Per own particle, of 10^5 and 10^6 a rank; of all pairs, since two ranks share a cut one.
TEST(rank_cost, shares_of_usual_ranks) {
  const auto of = [](int n, double H) { return mean_share({{n, n, n}, {4, 4, 4}, 1, H}); };
  const auto cut = [](const rank_share& s) { return s.cut / 2 / pairs_summed(s, cut_mode::once); };
  const auto ghosts = [](const rank_share& s) { return s.ghosts / s.own; };
  EXPECT_NEAR(cut(of(46, 2)), 0.05, 0.005);
  EXPECT_NEAR(cut(of(100, 2)), 0.02, 0.005);
  EXPECT_NEAR(cut(of(46, 4.16)), 0.10, 0.005);
  EXPECT_NEAR(cut(of(100, 4.16)), 0.05, 0.005);
  EXPECT_NEAR(ghosts(of(46, 2)), 0.28, 0.005);
  EXPECT_NEAR(ghosts(of(100, 2)), 0.13, 0.006);
  EXPECT_NEAR(ghosts(of(46, 4.16)), 0.65, 0.01);
  EXPECT_NEAR(ghosts(of(100, 4.16)), 0.27, 0.005);
}

/// The line that docs/model.md should have for a rank of n^3 particles.
std::string documented(int n, double H) {
  const lattice_box box{{n, n, n}, {4, 4, 4}, 1, H};
  const rank_share lattice = counted_share(box), mean = mean_share(box);
  const auto cut = [](const rank_share& s) { return 100 * s.cut / (s.cut + 2 * s.inner); };
  return fmt::format("| {}^3 | {:g} dx | {:.3f} | {:.3f} | {:.2f} % | {:.2f} % |", n, H, lattice.ghosts / lattice.own,
                     mean.ghosts / mean.own, cut(lattice), cut(mean));
}

TEST(rank_cost, the_documented_table_is_computed) {
  std::ifstream file(PAIRSUM_MODEL_DOCUMENT);
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  for (const int n : {46, 100})
    for (const double H : {2.0, 4.16}) EXPECT_TRUE(says(document, {documented(n, H)})) << documented(n, H);
  EXPECT_FALSE(says(document, {documented(47, 2)}));
}

rank_share small() { return {.own = 100, .ghosts = 20, .inner = 1000, .cut = 200, .neighbours = 7}; }

TEST(rank_cost, time_of_an_evaluation_in_both_modes) {
  rank_share more_work = small(), more_messages = small();
  more_work.inner = 2000;
  more_work.ghosts = 0;
  more_messages.ghosts = 40;
  const std::vector<rank_share> ranks{more_work, more_messages};
  const unit_costs costs{.s_per_particle = 3, .s_per_pair = 5};
  const ghost_bytes bytes{.particle = 80, .rates = 32};
  const link_rates link{.latency_s = 11, .bandwidth_bytes_per_s = 4};
  EXPECT_DOUBLE_EQ(evaluation_s(ranks, costs, bytes, link, cut_mode::twice),
                   (100 * 3 + 2200 * 5) + (7 * 11 + 40 * 80 / 4));
  EXPECT_DOUBLE_EQ(evaluation_s(ranks, costs, bytes, link, cut_mode::once),
                   (100 * 3 + 2100 * 5) + (14 * 11 + 40 * 112 / 4));
  const rank_share alone = counted_share({{8, 8, 8}, {1, 1, 1}, 1, 2});
  EXPECT_EQ(alone.cut + alone.ghosts + alone.neighbours, 0);
  EXPECT_DOUBLE_EQ(evaluation_s({&alone, 1}, costs, bytes, link, cut_mode::once), 512 * 3 + 512 * 13 * 5);
}

TEST(rank_cost, refuses_what_is_no_domain) {
  const auto counted = [](const lattice_box& b) { return error_of([&] { counted_share(b); }); };
  const auto mean = [](const lattice_box& b) { return error_of([&] { mean_share(b); }); };
  for (const auto& of : {std::function(counted), std::function(mean)}) {
    EXPECT_TRUE(says(of({{0, 4, 4}, {3, 3, 3}, 1, 2}), {"particles", "positive", "is 0"}));
    EXPECT_TRUE(says(of({{4, 4, 4}, {3, -1, 3}, 1, 2}), {"ranks", "positive", "is -1"}));
    EXPECT_TRUE(says(of({{4, 4, 4}, {3, 3, 3}, 0, 2}), {"dx", "positive", "is 0"}));
    EXPECT_TRUE(says(of({{4, 4, 4}, {3, 3, 3}, 1, 2, -0.1}), {"skin", "not negative", "is -0.1"}));
    EXPECT_TRUE(says(of({{4, 4, 4}, {3, 3, 3}, 1, std::nan("")}), {"H", "finite"}));
    EXPECT_TRUE(says(of({{4, 5, 5}, {1, 1, 1}, 1, 1.5}), {"3 H", "4.5 m", "this one 4 m"}));
  }
  EXPECT_TRUE(says(mean({{2, 9, 9}, {9, 2, 2}, 1, 3}), {"at least H wide", "3 m", "2 m"}));
  EXPECT_EQ(counted({{2, 9, 9}, {9, 2, 2}, 1, 3}), "");
  EXPECT_EQ(mean({{9, 9, 9}, {1, 1, 1}, 1, 3}), "");
}

TEST(rank_cost, refuses_costs_that_are_none) {
  const std::vector<rank_share> one{small()};
  const auto refusal = [&](const unit_costs& costs, const ghost_bytes& bytes, const link_rates& link) {
    return error_of([&] { evaluation_s(one, costs, bytes, link, cut_mode::once); });
  };
  const unit_costs c{1, 1};
  const ghost_bytes b{1, 1};
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(c, b, {0, 1}), "");
  EXPECT_TRUE(says(refusal({-1, 1}, b, {1, 1}), {"particle", "negative"}));
  EXPECT_TRUE(says(refusal({1, infinite}, b, {1, 1}), {"pair", "finite"}));
  EXPECT_TRUE(says(refusal(c, {-1, 1}, {1, 1}), {"record", "negative"}));
  EXPECT_TRUE(says(refusal(c, {1, -1}, {1, 1}), {"rates", "negative"}));
  EXPECT_TRUE(says(refusal(c, b, {-1, 1}), {"latency", "negative"}));
  EXPECT_TRUE(says(refusal(c, b, {1, 0}), {"bandwidth", "positive"}));
  EXPECT_TRUE(says(error_of([&] { evaluation_s({}, c, b, {1, 1}, cut_mode::once); }), {"at least one rank"}));
}

}  // namespace
}  // namespace pairsum::harness
