// A job in which one rank alone meets an error: its particles are too far apart for a dense_grid. Its line must be
// printed and the job must end; the other ranks are waiting in calls of MPI then.
#include <cstdio>

#include "ranked_scene.hpp"

int main() {
  using namespace pairsum;
  try {
    const ranks::job job;
    setup s;
    s.backend = "symmetric";
    s.grid = "dense_grid";
    s.constants.H = 1;
    s.omega_low.assign(3, 0);
    s.omega_high.assign(3, 3000);
    particle_table p(3);
    p.resize(3000);
    for (std::uint32_t k = 0; k < 3000; ++k) {
      for (std::uint32_t d = 0; d < 3; ++d)
        p.x[d][k] = k < 20 ? (k % 2 == 0 ? 5 : 3000) : (k * (d + 7) * 37) % 1009 / 200.0;
      p.rho[k] = 1000;
      p.m[k] = 1;
      p.kind[k] = particle_kind::fluid;
    }
    auto sum = ranks::make_ranked(registry::instance().make_summation(s), {});
    sum->load(p, {});
    for (int k = 0; k < 2; ++k) sum->evaluate(team());
    std::printf("rank %d: done\n", job.rank());
  } catch (const error& e) {
    std::printf("one_rank_throws: %s\n", e.what());
    return 2;
  }
}
