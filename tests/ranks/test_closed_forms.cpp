#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "harness/model/link.hpp"
#include "harness/model/rank_cost.hpp"
#include "ranked_scene.hpp"

// What the model says of ranks against what ranks count and send.
namespace pairsum {
namespace {

using namespace test_kit;

/// A cube of n^3 particles as a power of two ranks cuts it: in halves, along one axis after the other.
harness::lattice_box half_cubes(int n, double H_in_dx, double skin_in_H) {
  harness::lattice_box b{{n, n, n}, {1, 1, 1}, 1.0 / n, H_in_dx / n, skin_in_H * H_in_dx / n};
  std::size_t d = 0;
  for (int ranks = this_job().size(); ranks > 1; ranks /= 2, d = (d + 1) % 3) {
    b.particles[d] /= 2;
    b.ranks[d] *= 2;
  }
  return b;
}

class rank_model : public testing::TestWithParam<cut_pairs> {
 protected:
  void SetUp() override {
    if (std::ranges::count(std::array{1, 2, 4, 8, 64}, this_job().size()) == 0)
      GTEST_SKIP() << "1, 2, 4, 8 or 64 ranks have equal neighbours";
  }
};
INSTANTIATE_TEST_SUITE_P(closed_forms, rank_model, testing::Values(cut_pairs::twice, cut_pairs::once),
                         [](const auto& i) { return i.param == cut_pairs::once ? "once" : "twice"; });

struct lattice_case {
  int n;
  double H_in_dx, skin_in_H;
};

/// A cut may lie a quarter of a spacing beside the middle between two layers; no H + skin here is that near to another
/// layer. Halos of 2 layers, of 3 where no pair reaches the third, and so wide that all particles are own or ghosts.
TEST_P(rank_model, says_what_ranks_count) {
  const auto mode = GetParam() == cut_pairs::once ? harness::cut_mode::once : harness::cut_mode::twice;
  for (const auto& [n, H, skin] : {lattice_case{12, 2.1, 0}, lattice_case{12, 2.1, 0.4}, lattice_case{12, 2.8, 0},
                                   lattice_case{16, 2.6, 0.1}, lattice_case{16, 3.2, 0}, lattice_case{8, 2.1, 0}}) {
    SCOPED_TRACE(testing::Message() << n << "^3 particles, H = " << H << " dx, skin " << skin << " H");
    const harness::lattice_box box = half_cubes(n, H, skin);
    const harness::rank_share share = harness::counted_share(box);
    scene s = make_scene_in(3, "periodic_lattice", box.dx, "rest");
    s.world.constants.H = box.H;
    auto sum = ranked(with(s.world, "symmetric", {"compact_grid", 0}), {.pairs = GetParam(), .skin = skin});
    sum->load(s.particles, {});
    for (const bool first : {true, false}) {
      sum->evaluate(team());
      const bool records = first || skin == 0;  // nobody moves: else the ghosts of the first serve
      const harness::ghost_bytes bytes{.particle = records ? 8.0 * (3 + 3 + 2) + 4 + 1 : 8.0 * (3 + 3 + 1),
                                       .rates = 8 * (1 + 3)};
      const harness::rank_traffic sent = harness::traffic_of(share, bytes, mode);
      double pairs = 0, cut = 0;
      const auto facts = ranks::facts_of(*sum);
      for (const ranks::rank_facts& f : facts) {
        EXPECT_EQ(static_cast<double>(f.own), share.own);
        EXPECT_EQ(static_cast<double>(f.ghosts), share.ghosts);
        EXPECT_EQ(static_cast<double>(f.halo.messages), share.neighbours);
        EXPECT_EQ(static_cast<double>(f.halo.messages + f.send_back.messages), sent.messages);
        EXPECT_EQ(static_cast<double>(f.halo.bytes + f.send_back.bytes), sent.bytes);
        EXPECT_EQ(static_cast<double>(f.pairs - f.cut), share.inner);
        if (mode == harness::cut_mode::twice) {
          EXPECT_EQ(static_cast<double>(f.cut), share.cut);
        }
        pairs += static_cast<double>(f.pairs);
        cut += static_cast<double>(f.cut);
      }
      const auto ranks = static_cast<double>(facts.size());
      EXPECT_EQ(pairs, ranks * harness::pairs_summed(share, mode));
      EXPECT_EQ(cut, ranks * share.cut / (mode == harness::cut_mode::once ? 2 : 1));
      EXPECT_EQ(static_cast<double>(sum->count_work().pairs_fluid_fluid), ranks * (share.inner + share.cut / 2));
    }
  }
}

/// Rank 1 sees what rank 0 sent, and sends it back.
TEST(bounce, brings_the_message_there_and_back) {
  std::vector<std::byte> message(1000, static_cast<std::byte>(this_job().rank()));
  message[999] = std::byte{200};
  if (this_job().size() == 1) {
    EXPECT_TRUE(says(error_of([&] { this_job().bounce(message); }), {"two ranks", "has one"}));
    return;
  }
  for (int k = 0; k < 3; ++k) this_job().bounce({message.data(), 999});
  const int rank = this_job().rank();
  EXPECT_EQ(message[0], static_cast<std::byte>(rank == 1 ? 0 : rank)) << "of rank 0";
  EXPECT_EQ(message[998], message[0]);
  EXPECT_EQ(message[999], std::byte{200}) << "not sent";
}

TEST(bounce, is_a_link_of_finite_rates) {
  if (this_job().size() != 2) GTEST_SKIP() << "for two ranks";
  const auto bounce = [](std::span<std::byte> m) { this_job().bounce(m); };
  const harness::link_rates r = harness::measure_link(bounce, this_job().rank() == 0);
  if (this_job().rank() != 0) return;
  EXPECT_GT(r.latency_s, 0);
  EXPECT_GT(r.bandwidth_bytes_per_s, 0);
}

}  // namespace
}  // namespace pairsum
