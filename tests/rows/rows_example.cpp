/// rows_example write PATH: writes one row of every kind. rows_example check PATH: reads a rows
/// file strictly; prints what is wrong and exits 2 if it is no valid one.
#include <cstdio>
#include <string>

#include <pairsum/core/error.hpp>
#include "harness/rows/reader.hpp"
#include "harness/rows/writer.hpp"
#include "tests/rows/example_rows.hpp"

int main(int argc, char** argv) {
  using namespace pairsum::harness;
  const std::string command = argc == 3 ? argv[1] : "";
  try {
    if (command == "write") {
      row_writer writer(argv[2]);
      writer.write(example::environment());
      writer.write(example::peak());
      writer.write(example::backend());
      writer.write(example::particles());
      writer.write(example::measured());
      writer.write(example::of_files());
      writer.write(example::of_ranks());
      writer.write(example::untimed());
      writer.write(example::failed());
      writer.write(example::pace());
      writer.write(example::closing(5));
      writer.write(example::ended());
      writer.write(example::voided());
      return 0;
    }
    if (command == "check") return read_rows(argv[2]).size() > 0 ? 0 : 2;
  } catch (const pairsum::error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  std::fprintf(stderr, "usage: rows_example write|check PATH\n");
  return 2;
}
