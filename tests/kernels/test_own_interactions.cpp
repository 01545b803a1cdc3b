#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/pairsum.hpp>
#include "scene.hpp"

// Interactions as a user writes them: a single scalar, a single vector, nothing but places.
namespace pairsum {
namespace {

using namespace test_kit;

/// rho_i = sum_j m_j W_ij
struct density {
  static constexpr std::string_view name = "density", rate_name = "rho";
  static constexpr int dim = 3;
  using real = double;
  template <class T>
  using particle = T;
  template <class T>
  using rates = T;
  wendland_c2<dim, real> W;
  explicit density(const physics& p) : W(p.H) {}
  template <class T>
  T derive(const particle_state<dim, T>& s) const {
    return s.m;
  }
  template <class T>
  contributions<T> pair(const vec<dim, T>&, const T& r2, const T& m_i, const T& m_j) const {
    const T w = W.value(square_root(r2));
    return {m_j * w, m_i * w};
  }
};

/// The force of a Lennard-Jones fluid in 2D, sigma = H/2.5, softened so that coincident particles are legal.
template <int Lie>
struct lennard_jones {
  static constexpr std::string_view name = "lennard_jones", rate_name = "force";
  static constexpr int dim = 2;
  using real = float;
  template <class T>
  using particle = nothing;
  template <class T>
  using rates = vec<dim, T>;
  double sigma2;
  explicit lennard_jones(const physics& p) : sigma2(p.H * p.H / 6.25) {}
  template <class T>
  nothing derive(const particle_state<dim, T>&) const {
    return {};
  }
  template <class T>
  contributions<vec<dim, T>> pair(const vec<dim, T>& r, const T& r2, nothing, nothing) const {
    const T soft = r2 + T(0.2 * sigma2), s6 = power(T(sigma2) / soft, 3);
    const vec<dim, T> f = (s6 * (s6 - T(0.5)) / soft) * r;
    return {f, T(-1 - Lie) * f};
  }
};

/// Rates in an order of their own, and one more: every pair adds 1 to drho, 2 to energy, nothing to dv.
struct odd_order {
  static constexpr std::string_view name = "odd_order";
  static constexpr int dim = 2;
  using real = double;
  template <class T>
  using particle = nothing;
  template <class T>
  struct rates {
    vec<dim, T> dv;
    T energy, drho;
    static constexpr auto fields() { return std::make_tuple(&rates::dv, &rates::energy, &rates::drho); }
    static constexpr std::array<std::string_view, 3> names{"dv", "energy", "drho"};
  };
  explicit odd_order(const physics&) {}
  template <class T>
  nothing derive(const particle_state<dim, T>&) const {
    return {};
  }
  template <class T>
  contributions<rates<T>> pair(const vec<dim, T>&, const T&, nothing, nothing) const {
    const rates<T> one{vec<dim, T>(T(0), T(0)), T(2), T(1)};
    return {one, one};
  }
};

template <class I>
registry with_own() {
  registry all = registry::instance();
  all.add(formula_entry_of<I>());
  return all;
}

/// By backend and instruction set: `best` is the one that this source is compiled for, if it has vector units.
template <class I>
std::map<std::string, double> shares_of_bound(double dx) {
  const initial_condition c = make_case("lattice", {.dim = I::dim, .dx = dx, .H = 2.5 * dx, .state = "perturbed"});
  const registry own = with_own<I>();
  setup s = setup_of(c);
  s.dim = I::dim;
  s.interaction = I::name;
  s.precision = precision_name<typename I::real>();
  const expectation e = own.make_reference(s)->brute_force(c.particles, some_threads());
  EXPECT_GT(e.pairs_fluid_fluid, 1000u);
  std::map<std::string, double> shares;
  for (const backend_entry& b : own.backends()) {
    s.backend = b.traits.name;
    s.M = 4;
    for (const char* isa : {"scalar", "best"}) {
      if (b.traits.conflicts == conflict_avoidance::atomics && isa == best_isa) continue;
      s.isa = isa;
      const auto sum = own.make_summation(s);
      workers w(b.traits.threads, 3);
      sum->load(c.particles, {});
      sum->evaluate(w.get());
      EXPECT_EQ(sum->count_work().pairs_fluid_fluid, e.pairs_fluid_fluid) << s.backend;
      shares[s.backend + " " + isa] = share_of_bound(sum->rates(), e);
    }
  }
  return shares;
}

TEST(own_interactions, a_single_scalar_is_summed_by_every_backend) {
  const auto shares = shares_of_bound<density>(0.1);
  EXPECT_EQ(shares.size(), 2 * backend_names().size() - 1) << "atomic_add is scalar alone";
  for (const auto& [backend, share] : shares) EXPECT_LE(share, 1) << backend;
  EXPECT_EQ(rate_names<density>(), std::vector<std::string>{"rho"});
}

TEST(own_interactions, a_single_vector_is_summed_by_every_backend) {
  const auto shares = shares_of_bound<lennard_jones<0>>(0.03);
  EXPECT_EQ(shares.size(), 2 * backend_names().size() - 1) << "atomic_add is scalar alone";
  for (const auto& [backend, share] : shares) EXPECT_LE(share, 1) << backend;
  EXPECT_EQ(rate_names<lennard_jones<0>>(), (std::vector<std::string>{"force_x", "force_y"}));
}

TEST(own_interactions, join_those_of_the_library) {
  registry own = with_own<density>();
  own.add(formula_entry_of<odd_order>());
  EXPECT_EQ(own.backends().size(), backend_names().size());
  std::vector<std::string> all = registry::instance().interactions();
  all.insert(all.end(), {"density", "odd_order"});
  EXPECT_EQ(own.interactions(), all);
  EXPECT_EQ(error_of([&] { own.add(formula_entry_of<density>()); }), "there is a formula density/3D/double already");
}

TEST(own_interactions, time_steps_find_drho_and_dv_by_name) {
  const initial_condition c = make_case("lattice", {.dim = 2, .dx = 0.1});
  const registry own = with_own<odd_order>();
  setup s = setup_of(c);
  s.interaction = odd_order::name;
  s.M = 4;
  const auto sum = own.make_summation(s);
  sum->load(c.particles, {});
  find_integrator("euler").step(
      *sum, 0.5, 0, [&] { sum->evaluate(team()); }, team());
  const particle_table now = sum->snapshot();
  const rate_table rates = sum->rates();
  EXPECT_EQ(rates.names, (std::vector<std::string>{"dv_x", "dv_y", "energy", "drho"}));
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_GT(rates.columns[3][i], 0);
    EXPECT_EQ(now.rho[i], c.particles.rho[i] + 0.5 * rates.columns[3][i]);
    EXPECT_EQ(now.v[0][i], 0);
    EXPECT_EQ(now.v[1][i], 0);
  }
}

/// The reference takes one side of a pair from either particle: sides that do not match are found out.
TEST(own_interactions, one_that_lies_is_found_out) {
  for (const auto& [backend, share] : shares_of_bound<lennard_jones<1>>(0.05)) {
    if (!backend.starts_with("naive")) {
      EXPECT_GT(share, 1) << backend;
    }
  }
}

}  // namespace
}  // namespace pairsum
