#pragma once

#include "harness/rows/writer.hpp"
#include "tests/rows/example_rows.hpp"

namespace pairsum::harness {

/// Writes a sample, and first the row of its backend if that is not there.
inline void write_sample(row_writer& writer, const sample& s) {
  backend_row b = example::backend();
  b.study = s.study;
  b.environment = s.environment;
  b.name = s.point.backend;
  if (!writer.knows(b.environment, b.name)) writer.write(b);
  writer.write(s);
}

}  // namespace pairsum::harness
