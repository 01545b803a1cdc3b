#pragma once
#include <stdexcept>

namespace pairsum {

/// Bad input. `what()` is one line that names what is wrong and what would be right.
struct error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A word that is known, but that this build or this machine does not have.
struct unavailable : error {
  using error::error;
};

}  // namespace pairsum
