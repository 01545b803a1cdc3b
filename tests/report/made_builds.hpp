#pragma once

#include "tests/report/report_fixture.hpp"

/// Rows of several builds.
namespace pairsum::harness::synthetic {

/// The environment of another build, with an id of 16 times the digit.
inline environment_row build(char digit, const std::string& compiler, const std::string& git = "abc1234",
                             bool dirty = false) {
  environment_row e = example::environment();
  e.environment = std::string(16, digit);
  e.compiler = compiler;
  e.git = git;
  e.dirty = dirty;
  return e;
}

/// A point as that build measured it.
inline made_point by(const environment_row& e, made_point p) {
  p.change = [id = e.environment, change = p.change](sample& s) {
    s.environment = id;
    if (change) change(s);
  };
  return p;
}

inline round_row closing_by(const environment_row& e, int round, std::size_t rows, const std::string& study = "talk") {
  round_row r = closing(round, rows);
  r.environment = e.environment;
  r.study = study;
  return r;
}

/// A file of rounds in which all points were measured, with rows of these environments.
inline void write_builds(const std::filesystem::path& path, const std::vector<environment_row>& environments,
                         const std::vector<made_point>& points, int rounds = 6) {
  row_writer writer(path);
  for (const environment_row& e : environments) writer.write(e);
  for (int round = 1; round <= rounds; ++round) {
    for (const made_point& p : points)
      for (int i = 1; i <= 2; ++i) write_sample(writer, step(p, round, i));
    writer.write(closing_by(environments.front(), round, 2 * points.size()));
  }
}

}  // namespace pairsum::harness::synthetic
