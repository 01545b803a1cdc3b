#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "harness/evolve/balance.hpp"
#include "harness/evolve/simulation.hpp"

namespace pairsum::harness {

/// log.csv of a simulation: a row per time that is logged. Units are in the names of the columns.
class simulation_log {
 public:
  /// Keeps the rows of a file that is there up to `step`, drops those after it; `step` 0: begins anew.
  simulation_log(const std::filesystem::path& file, std::uint64_t step);
  /// @param dt s, of the step made last
  void write(const moment& m, double dt, const balance& b);
  /// The energy of the first row that is there, J.
  std::optional<double> first_energy() const { return first_energy_; }
  /// Throws pairsum::error if rows were lost.
  void flush();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::optional<double> first_energy_;
};

}  // namespace pairsum::harness
