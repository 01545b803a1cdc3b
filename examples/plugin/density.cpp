// The interaction "density", rho_i = sum_j m_j W(|x_i - x_j|) in 3D and double precision: summed by every backend of
// the program and checked against the library's reference. What an interaction needs is said in
// pairsum/interactions/interaction.hpp.
#include <pairsum/pairsum.hpp>

namespace {

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

}  // namespace

formula_entry density_entry() { return formula_entry_of<density>(); }
