#pragma once
#include <array>
#include <string>
#include <vector>

#include <pairsum/core/random.hpp>
#include <pairsum/integrators/integrator.hpp>
#include "scene.hpp"

// A smooth problem for the tests of integrators: clusters of particles on springs that cross many cells.
namespace pairsum::test_kit {

/// The library's and the interaction `oscillators`: 1D, 2D and 3D in double, 3D in float; under AddressSanitizer, for
/// which they take long to compile, 3D in double alone.
const registry& oscillator_registry();

constexpr std::uint32_t oscillator_count = 16;

/// Four clusters of four particles, far apart from each other, that cross two or three cells in a unit of time; and a
/// still boundary particle in two corners of Omega. H = 1. Every value is a float's.
inline scene make_oscillators(int D, double kappa) {
  const counter_random random(3);
  scene s;
  setup& w = s.world;
  w.interaction = "oscillators";
  w.dim = D;
  w.M = 3;
  w.constants = {1, {1, kappa}};
  w.omega_low.assign(D, -4);
  w.omega_high.assign(D, 20);
  particle_table& p = s.particles = particle_table(D);
  p.resize(oscillator_count + 2);
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const bool fluid = i < oscillator_count;
    const int cluster = i % 4;  // a cluster's particles do not follow each other
    const auto u = [&](int n, double low, double high) { return random.uniform(10 * i + n, low, high); };
    for (int d = 0; d < D; ++d) {
      const double place = d == 0 ? 5 * cluster : 5 * (cluster % 2);
      const double speed = d == 0 ? 3 - cluster % 2 : cluster >> d & 1 ? -2 : 2;
      p.x[d][i] = fluid ? static_cast<float>(place + u(d, -0.12, 0.12)) : i == oscillator_count ? -4 : 20;
      p.v[d][i] = fluid ? static_cast<float>(speed + u(3 + d, -0.3, 0.3)) : 0;
    }
    p.rho[i] = static_cast<float>(u(6, 0.8, 1.2));
    p.m[i] = static_cast<float>(u(7, 0.6, 1));
    p.kind[i] = fluid ? particle_kind::fluid : particle_kind::boundary;
  }
  return s;
}

/// What integrators change, of every fluid particle: D components of x, D of v, then rho.
using unknowns = std::vector<std::array<long double, 7>>;

inline unknowns unknowns_of(const particle_table& p) {
  unknowns y(oscillator_count);
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = {};
    for (int d = 0; d < p.dim; ++d) y[i][d] = p.x[d][i], y[i][p.dim + d] = p.v[d][i];
    y[i][2 * p.dim] = p.rho[i];
  }
  return y;
}

/// y + a k
inline unknowns plus(unknowns y, long double a, const unknowns& k) {
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t c = 0; c < 7; ++c) y[i][c] += a * k[i][c];
  return y;
}

/// dy/dt by the formula of `oscillators` written down a second time, one particle at a time; for particles of which
/// those of one cluster alone are within H.
inline unknowns derivative(const scene& s, double gravity, const unknowns& y) {
  const int D = s.world.dim;
  const long double kappa = s.world.constants.eos.B;
  unknowns k(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    k[i] = {};
    for (int d = 0; d < D; ++d) k[i][d] = y[i][D + d];
    k[i][D + (D > 1)] = -gravity;
    for (std::size_t j = i % 4; j < y.size(); j += 4) {
      const long double m = s.particles.m[j], rho_i = y[i][2 * D], rho_j = y[j][2 * D];
      for (int d = 0; d < D; ++d) {
        const long double r = y[i][d] - y[j][d], v = y[i][D + d] - y[j][D + d];
        k[i][D + d] -= m * (4 * (1 + kappa * (rho_i + rho_j - 2)) * r + v / 2);
        k[i][2 * D] += m * kappa * v * r;
      }
      k[i][2 * D] += m * (rho_j - rho_i);
    }
  }
  return k;
}

/// The largest difference in components [begin, end).
inline long double difference(const unknowns& a, const unknowns& b, int begin = 0, int end = 7) {
  long double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = begin; c < end; ++c) {
      const long double error = std::abs(a[i][c] - b[i][c]);
      largest = error <= largest ? largest : error;  // a NaN is the largest
    }
  return largest;
}

}  // namespace pairsum::test_kit
