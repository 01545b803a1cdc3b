#include <pairsum/sum/check.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/sum/omega.hpp>

namespace pairsum {
namespace {

bool inside(const particle_table& p, std::size_t i, const setup& s) {
  bool in = true;
  for (std::size_t d = 0; d < s.omega_low.size(); ++d) {
    const double x = p.x[d][i];
    in = in && (s.periodic.on[d] ? std::isfinite(x) : x >= s.omega_low[d] && x <= s.omega_high[d]);
  }
  return in;
}

std::string text(double a) { return number_text(a); }

/// What the formulas, which go up to H^-5 in 3D, can take without overflow, with some room for their factors.
struct precision_range {
  double low, high, largest;
};
precision_range range_of(const std::string& precision) {
  if (precision == precision_name<float>()) return {1e-32, 1e32, std::numeric_limits<float>::max()};
  if (precision == mixed_precision) return {1e-32, 1e32, std::numeric_limits<double>::max()};
  return {1e-300, 1e300, std::numeric_limits<double>::max()};
}

void check_columns(const particle_table& p) {
  const auto is = [](const std::string& name, std::size_t got, std::size_t expected, const char* of) {
    if (got != expected)
      throw error(name + " of the particles has " + std::to_string(got) + of + ", must have " +
                  std::to_string(expected));
  };
  const auto dim = static_cast<std::size_t>(p.dim);
  is("x", p.x.size(), dim, " columns");
  is("v", p.v.size(), dim, " columns");
  for (std::size_t d = 0; d < dim; ++d) {
    is("column x_" + std::string(1, "xyz"[d]), p.x[d].size(), p.size(), " rows");
    is("column v_" + std::string(1, "xyz"[d]), p.v[d].size(), p.size(), " rows");
  }
  is("column rho", p.rho.size(), p.size(), " rows");
  is("column m", p.m.size(), p.size(), " rows");
}

}  // namespace

void check_domain(const setup& s) {
  if (!(s.constants.H > 0) || !std::isfinite(s.constants.H))
    throw error("the support radius H must be a positive length, is " + text(s.constants.H));
  const precision_range range = range_of(s.precision);
  const double power = std::pow(s.constants.H, 5);
  if (!(power >= range.low && power <= range.high))
    throw error("the support radius H of " + text(s.constants.H) + " m does not suit precision " + s.precision +
                ": H^5 must lie between " + text(range.low) + " and " + text(range.high));
  if (s.omega_low.size() != static_cast<std::size_t>(s.dim) || s.omega_high.size() != s.omega_low.size())
    throw error("Omega must have corners of " + std::to_string(s.dim) + " components, has " +
                std::to_string(s.omega_low.size()) + " and " + std::to_string(s.omega_high.size()));
  for (std::size_t d = 0; d < s.omega_low.size(); ++d)
    if (!std::isfinite(s.omega_low[d]) || !std::isfinite(s.omega_high[d]) || !(s.omega_low[d] <= s.omega_high[d]))
      throw error("Omega must have finite corners with A <= B, component " + std::to_string(d) + " is [" +
                  text(s.omega_low[d]) + ", " + text(s.omega_high[d]) + "]");
  for (std::size_t d = 0; d < s.omega_low.size(); ++d)
    if (std::max(std::abs(s.omega_low[d]), std::abs(s.omega_high[d])) > range.largest)
      throw error("Omega does not fit into precision " + s.precision + ": component " + std::to_string(d) + " is [" +
                  text(s.omega_low[d]) + ", " + text(s.omega_high[d]) + "]");
  for (int d = s.dim; d < 3; ++d)
    if (s.periodic[d])
      throw error("a " + std::to_string(s.dim) + "D domain has no axis " + "xyz"[d] + " that could be periodic");
  for (std::size_t d = 0; d < s.omega_low.size(); ++d)
    if (const double reaches = (s.omega_high[d] - s.omega_low[d]) / s.constants.H;
        s.periodic.on[d] && !(reaches > 2.999))
      throw error("a periodic box must be 3 support radii or more along each periodic axis, component " +
                  std::to_string(d) + " is " + text(reaches));
}

void check_input(const particle_table& p, const setup& s) {
  if (p.dim != s.dim)
    throw error("the particles are " + std::to_string(p.dim) + "D, the summation is " + std::to_string(s.dim) + "D");
  check_columns(p);
  check_domain(s);
  if (p.size() > most_particles) throw error("at most 2^32 - 1025 particles can be summed");
  const bool single = s.precision != precision_name<double>();  // what a pair's terms are made of must fit
  const bool single_position = s.precision == precision_name<float>();
  std::size_t outside = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto rounded = [&](double a) { return single ? static_cast<double>(static_cast<float>(a)) : a; };
    const auto finite = [&](double a, const char* what, bool in_float) {
      if (!std::isfinite(in_float ? static_cast<double>(static_cast<float>(a)) : a))
        throw error("particle " + std::to_string(i) + " has a " + what + " that is not finite" +
                    (in_float ? " in float" : "") + " (" + text(a) + ")");
    };
    const auto positive = [&](double a, const char* what) {
      finite(a, what, single);
      if (!(rounded(a) > 0))
        throw error("particle " + std::to_string(i) + " has a " + what + " of " + text(a) + ", which must be positive" +
                    (single ? " in float" : ""));
    };
    for (int d = 0; d < p.dim; ++d) {
      finite(p.x[d][i], "position", single_position);
      finite(p.v[d][i], "velocity", single);
    }
    positive(p.rho[i], "density");
    positive(p.m[i], "mass");
    outside += !inside(p, i, s);
  }
  if (outside > 0)
    throw error(std::to_string(outside) + " of " + std::to_string(p.size()) +
                " particles lie outside Omega; move them, enlarge Omega, or drop them (--outside drop)");
}

template <class R>
void check_apart(const particle_table& p, std::string_view interaction, const setup& s) {
  std::vector<std::vector<R>> place;  // along a periodic axis a point has one
  for (std::size_t d = 0; d < p.x.size(); ++d) {
    place.emplace_back(p.x[d].begin(), p.x[d].end());
    if (!s.periodic.on[d]) continue;
    const box<1, R> axis = make_box_of_axis<R>(s, d);
    for (R& a : place[d]) a = axis.wrapped(0, a);
  }
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    for (const auto& x : place)
      if (x[i] != x[j]) return x[i] < x[j];
    return false;
  };
  std::vector<std::uint32_t> boundary;
  for (std::uint32_t i = 0; i < p.size(); ++i)
    if (p.kind[i] == particle_kind::boundary) boundary.push_back(i);
  std::ranges::sort(boundary, before);
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    const auto at = std::ranges::lower_bound(boundary, i, before);
    if (at != boundary.end() && !before(i, *at))
      throw error("fluid particle " + std::to_string(i) + " lies exactly on boundary particle " + std::to_string(*at) +
                  ", where the boundary force of " + std::string(interaction) + " is infinite; move one of them");
  }
}
template void check_apart<double>(const particle_table&, std::string_view, const setup&);
template void check_apart<float>(const particle_table&, std::string_view, const setup&);

void check_order(const std::vector<std::uint32_t>& order, std::size_t rows) {
  if (order.empty()) return;
  std::vector<bool> seen(rows, false);
  bool once = order.size() == rows;
  for (std::size_t k = 0; once && k < rows; ++k) {
    once = order[k] < rows && !seen[order[k]];
    if (once) seen[order[k]] = true;
  }
  if (!once) throw error("an order of memory must name each of the " + std::to_string(rows) + " particles once");
}

std::size_t drop_outside(particle_table& p, const setup& s) {
  std::size_t kept = 0;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!inside(p, i, s)) continue;
    for (int d = 0; d < p.dim; ++d) {
      p.x[d][kept] = p.x[d][i];
      p.v[d][kept] = p.v[d][i];
    }
    p.rho[kept] = p.rho[i];
    p.m[kept] = p.m[i];
    p.kind[kept] = p.kind[i];
    ++kept;
  }
  p.resize(kept);
  return n - kept;
}

}  // namespace pairsum
