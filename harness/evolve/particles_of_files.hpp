#pragma once
#include <string>

#include "harness/evolve/initial_of.hpp"

namespace pairsum::harness {

/// The particles of a request's files, completed by its hints and its H. Read once per process: the same files and
/// hints give the same again. Throws pairsum::error; in a build without kernels/files for any.
particles_of_request particles_of_files(const run_request& r);

/// What is known of them and how, as lines of a table.
std::string table_of(const particles_of_request& read);

}  // namespace pairsum::harness
