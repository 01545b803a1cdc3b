#pragma once
// What fuzzers of particle files share.
#include <cmath>
#include <span>

#include <pairsum/files/formats.hpp>
#include "on_file.hpp"

namespace pairsum::fuzz {

/// What was read of `size` bytes must be numbers, in columns of one length, that the file is long enough for.
inline void check_particles(const files::file_content& c, std::size_t size) {
  const std::size_t rows = c.x[0].size();
  if (rows == 0 || rows > size) fault("particles from nothing");
  const auto check = [&](const std::vector<double>& column) {
    if (!column.empty() && column.size() != rows) fault("columns of different lengths");
    if (column.capacity() > size) fault("memory for what is not there");
    for (const double number : column)
      if (!std::isfinite(number)) fault("a number that is not finite");
  };
  for (const auto& column : c.x) check(column);
  for (const auto& column : c.v) check(column);
  for (const auto& column : {c.rho, c.m, c.h}) check(column);
  for (const auto& [name, column] : c.others) check(column);
  if (!c.kind.empty() && c.kind.size() != rows) fault("kinds of a different length");
  // 2D may be in x and y or in x and z, as the file has it; velocities are along the same axes.
  const auto axes_of = [](const auto& columns) {
    return (columns[0].empty() ? 0 : 1) | (columns[1].empty() ? 0 : 2) | (columns[2].empty() ? 0 : 4);
  };
  const int of_x = axes_of(c.x), of_v = axes_of(c.v);
  if (c.dim == 2 ? of_x != 3 && of_x != 5 : of_x != 7) fault("axes that the dimension has not");
  if (of_v != 0 && of_v != of_x) fault("some velocities only");
  if (c.box_low.size() != c.box_high.size()) fault("half a box");
  for (std::size_t d = 0; d < c.box_low.size(); ++d)
    if (!c.x[d].empty() && !(c.box_low[d] < c.box_high[d])) fault("a box without inside");
  if (c.time && !std::isfinite(*c.time)) fault("a time that is not finite");
  for (const files::fact& f : c.facts) check_message(f.what + f.value + f.from);
}

inline void read_particle_file(const std::uint8_t* data, std::size_t size, const files::file_format& format,
                               const files::hints& told) {
  format.recognises(std::as_bytes(std::span(data, std::min<std::size_t>(size, 4096))), "particles");
  on_file(data, size, [&](const std::string& path) { check_particles(format.read(path, told), size); });
}

}  // namespace pairsum::fuzz
