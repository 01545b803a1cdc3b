#include "harness/simulate/log.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>

#include <pairsum/core/error.hpp>
#include "harness/rows/whole_file.hpp"

namespace pairsum::harness {
namespace {

constexpr const char* columns =
    "step,t_s,dt_s,kinetic_J,potential_J,internal_J,momentum_x_kg_m_s,momentum_y_kg_m_s,momentum_z_kg_m_s,"
    "x_low_m,x_high_m,y_low_m,y_high_m,z_low_m,z_high_m,speed_m_s,rho_low_kg_m3,rho_high_kg_m3,lost\n";

/// Of a row.
std::optional<double> energy_in(const std::string& line) {
  double step = 0, t = 0, dt = 0, kinetic = 0, potential = 0, internal = 0;
  const int found =
      std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &step, &t, &dt, &kinetic, &potential, &internal);
  return found == 6 ? std::optional(kinetic + potential + internal) : std::nullopt;
}

}  // namespace

simulation_log::simulation_log(const std::filesystem::path& file, std::uint64_t step) : file_(file) {
  std::string kept = columns, line;
  std::ifstream there(file);
  for (std::getline(there, line); step > 0 && std::getline(there, line);) {
    std::uint64_t of = 0;
    const auto [end, code] = std::from_chars(line.data(), line.data() + line.size(), of);
    if (code != std::errc() || *end != ',' || of > step || there.eof()) continue;
    if (!first_energy_) first_energy_ = energy_in(line);
    kept += line + "\n";
  }
  write_whole_file(kept, file);
  out_.open(file, std::ios::app);
}

void simulation_log::write(const moment& m, double dt, const balance& b) {
  if (!first_energy_) first_energy_ = b.energy();
  out_ << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", m.step, m.t, dt, b.kinetic,
                      b.potential, b.internal, b.momentum[0], b.momentum[1], b.momentum[2], b.low[0], b.high[0],
                      b.low[1], b.high[1], b.low[2], b.high[2], b.speed, b.rho_low, b.rho_high, m.lost);
}

void simulation_log::flush() {
  if (!out_.flush()) throw error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
}

}  // namespace pairsum::harness
