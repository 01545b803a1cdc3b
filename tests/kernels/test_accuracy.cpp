#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <pairsum/interactions/ferrari09.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>
#include "scene.hpp"

// The table of docs/accuracy.md: how far the rates of every backend are from those of the same particles in long
// double.
namespace pairsum {
namespace {

using namespace test_kit;

/// Rates and sums of absolute terms in long double, by the plain double loop.
struct exact_rates {
  std::vector<std::array<long double, 4>> value, magnitude;  ///< by id: drho, dv_x, dv_y, dv_z
};

exact_rates exactly(const particle_table& p, const setup& world) {
  using formula = ferrari09<3, long double, wendland_c2>;
  const formula f(world.constants);
  const auto state = [&](std::uint32_t i) {
    return particle_state<3, long double>{
        {p.x[0][i], p.x[1][i], p.x[2][i]}, {p.v[0][i], p.v[1][i], p.v[2][i]}, p.rho[i], p.m[i], i};
  };
  std::vector<formula::particle<long double>> derived(p.size());
  std::vector<vec<3, long double>> x(p.size());
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    derived[i] = f.derive(state(i));
    x[i] = state(i).x;
  }
  const long double H = world.constants.H;
  exact_rates u;
  u.value.resize(p.size());
  u.magnitude.resize(p.size());
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    const auto take = [&](const formula::rates<long double>& t) {
      each_scalar(t, [&](const long double& a, int slot) {
        u.value[i][slot] += a;
        u.magnitude[i][slot] += std::abs(a);
      });
    };
    for (std::uint32_t j = 0; j < p.size(); ++j) {
      if (j == i) continue;
      if (std::abs(x[i][0] - x[j][0]) > H) continue;
      const vec<3, long double> r = x[i] - x[j];
      const long double r2 = r.squaredNorm();
      if (p.kind[j] == particle_kind::fluid) {
        if (r2 < H * H) take(f.pair(r, r2, derived[i], derived[j]).to_i);
      } else if (r2 < H * H / 4) {
        take(f.boundary(r, r2, derived[i], f.derive_boundary(state(j))));
      }
    }
  }
  return u;
}

const scene& state() {
  static const scene s = make_scene("dam_break", 0.05, "perturbed");
  return s;
}

/// Largest |rate - exact| / sum of |terms|.
double largest_error(const rate_table& u, const exact_rates& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.value.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      if (exact.magnitude[i][c] > 0)
        worst =
            std::max(worst, static_cast<double>(std::abs(u.columns[c][i] - exact.value[i][c]) / exact.magnitude[i][c]));
  return worst;
}

/// What the table says of a backend in one precision.
struct accuracy_figures {
  double error = 0;       ///< largest distance from the exact rates
  double from_naive = 0;  ///< largest distance from the rates of naive
};

/// Exact rates of the particles as the precision holds them, empty at first.
exact_rates& known_exact(const std::string& precision) {
  static std::map<std::string, exact_rates> known;
  return known[precision];
}

double error_against_exact(const summation& sum, const setup& world) {
  auto& exact = known_exact(world.precision);
  if (exact.value.empty()) exact = exactly(sum.snapshot(), world);
  return largest_error(sum.rates(), exact);
}

/// 0 for a backend that does not take mixed precision.
double error_in_mixed(const std::string& backend) {
  if (backend == "atomic_add") return 0;
  setup world = with(state().world, backend, 5);
  world.precision = "mixed";
  return error_against_exact(*evaluated(world, state().particles), world);
}

accuracy_figures figures_of(const std::string& backend, const std::string& precision) {
  setup world = with(state().world, backend, 5);
  world.precision = precision;
  const auto sum = evaluated(world, state().particles);
  const double error = error_against_exact(*sum, world);
  world.backend = "naive";
  const rate_table naive = evaluated(world, state().particles)->rates();
  exact_rates as_naive = known_exact(precision);
  for (std::size_t i = 0; i < as_naive.value.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) as_naive.value[i][c] = naive.columns[c][i];
  return {error, largest_error(sum->rates(), as_naive)};
}

constexpr std::size_t figures = 5;

/// The numbers of the document's rows: "| `backend` | error in double | float | mixed | from naive in double | float
/// |".
std::map<std::string, std::array<double, figures>> documented() {
  std::ifstream file(PAIRSUM_ACCURACY_DOCUMENT);
  std::map<std::string, std::array<double, figures>> rows;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| `")) continue;
    const std::size_t end = line.find('`', 3);
    std::size_t bar = end;
    for (double& number : rows[line.substr(3, end - 3)]) {
      bar = line.find('|', bar + 1);
      number = std::atof(line.c_str() + bar + 1);
    }
  }
  return rows;
}

bool near(double documented, double measured) { return documented <= 2 * measured && measured <= 2 * documented; }

TEST(accuracy, the_documented_table_is_what_is_measured) {
  const auto& precisions = registry::instance().precisions();
  const auto has = [&](const char* word) { return std::ranges::count(precisions, word) > 0; };
  if (!has("float")) GTEST_SKIP() << "float is not built";
  const auto rows = documented();
  std::ostringstream table;
  table.precision(2);
  bool same = true;
  for (const std::string& backend : backend_names()) {
    const accuracy_figures d = figures_of(backend, "double"), f = figures_of(backend, "float");
    const double mixed = has("mixed") ? error_in_mixed(backend) : 0;
    const std::array<double, figures> measured{d.error, f.error, mixed, d.from_naive, f.from_naive};
    EXPECT_LT(d.error, 1e-13);
    EXPECT_LT(f.error, 1e-4);
    EXPECT_LT(mixed, 1e-5);
    const bool derives_itself =
        registry::instance().find_backend(backend).traits.vector;  // in code that fuses elsewhere
    EXPECT_LT(d.from_naive, derives_itself ? 1e-14 : 1e-15)
        << "differs from naive by more than the order of its additions";
    EXPECT_LT(f.from_naive, 1e-6);
    table << "| `" << backend << "` |";
    for (const double a : measured) table << " " << a << " |";
    table << "\n";
    const auto at = rows.find(backend);
    same = same && at != rows.end();
    for (std::size_t k = 0; same && k < figures; ++k)
      same = (k == 2 && !has("mixed")) || near(at->second[k], measured[k]) ||
             (k == 3 && derives_itself && measured[k] < at->second[k]);  // where it fuses is the compiler's choice
  }
  EXPECT_TRUE(same) << "docs/accuracy.md should hold about these rows:\n" << table.str();
  EXPECT_EQ(rows.size(), backend_names().size());
}

/// The measure sees what it should: a relative error of 1e-9 planted in one rate.
TEST(accuracy, the_measure_rejects_a_wrong_rate) {
  const auto sum = evaluated(with(state().world, "symmetric", 5), state().particles);
  const exact_rates exact = exactly(state().particles, state().world);
  rate_table u = sum->rates();
  EXPECT_LT(largest_error(u, exact), 1e-13);
  u.columns[2][100] += 1e-9 * static_cast<double>(exact.magnitude[100][2]);
  EXPECT_NEAR(largest_error(u, exact), 1e-9, 1e-12);
  EXPECT_FALSE(near(1e-15, 3e-15));
  EXPECT_TRUE(near(1e-15, 1.5e-15));
}

}  // namespace
}  // namespace pairsum
