// The density of SPH, rho_i = sum_j m_j W(|x_i - x_j|), as an interaction of one's own: summed by every algorithm of
// the library, each checked against the library's reference.
#include <cmath>
#include <cstdio>
#include <pairsum/pairsum.hpp>

using namespace pairsum;

// A particle brings its mass; what is summed is a density (kg/m3); a pair adds to both of its particles.
struct density {
  static constexpr std::string_view name = "density", rate_name = "rho";
  static constexpr int dim = 3;
  using real = double;
  template <class T> using particle = T;
  template <class T> using rates = T;
  wendland_c2<dim, real> W;
  explicit density(const physics& p) : W(p.H) {}
  template <class T> T derive(const particle_state<dim, T>& s) const { return s.m; }
  template <class T> contributions<T> pair(const vec<dim, T>&, const T& r2, const T& m_i, const T& m_j) const {
    const T w = W.value(square_root(r2));
    return {m_j * w, m_i * w};
  }
};

// The mean density of the particles with all their neighbours; a particle is no neighbour of itself, so its own term
// comes on top.
double mean_inside(const std::vector<double>& rho, const initial_condition& c) {
  const auto& p = c.particles;
  const double own = wendland_c2<3, double>(c.H).value(0.0);
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    bool inside = true;
    for (int d = 0; d < 3; ++d) inside = inside && p.x[d][i] > 1.5 * c.H && p.x[d][i] < 1 - 1.5 * c.H;
    if (!inside) continue;
    sum += rho[i] + p.m[i] * own;
    ++n;
  }
  return sum / static_cast<double>(n);
}

int main() {
  registry all = registry::instance();
  all.add(formula_entry_of<density>());

  const double dx = 1.0 / 16;
  const initial_condition water = make_case("lattice", {.dim = 3, .dx = dx, .H = 3 * dx, .state = "perturbed"});
  setup s = setup_of(water);
  s.interaction = "density";
  s.M = 4;  // the grid is folded to 2^4 cells an axis
  const expectation expected = all.make_reference(s)->brute_force(water.particles, workers(runtime::omp, 2).get());

  bool fine = true;
  std::printf("%-16s %-14s %s\n", "backend", "error/bound", "mean density in kg/m3");
  for (const backend_entry& b : all.backends()) {
    s.backend = b.traits.name;
    const auto sum = all.make_summation(s);
    const workers threads(b.traits.threads, 2);
    sum->load(water.particles, {});
    sum->evaluate(threads.get());
    const double share = share_of_bound(sum->rates(), expected);
    const double rho = mean_inside(sum->rates().columns[0], water);
    const bool good = share <= 1 && std::abs(rho / water.eos.rho0 - 1) < 0.01;
    std::printf("%-16s %-14.3g %.2f%s\n", s.backend.c_str(), share, rho, good ? "" : "   WRONG");
    fine = fine && good;
  }
  return fine ? 0 : 1;
}
