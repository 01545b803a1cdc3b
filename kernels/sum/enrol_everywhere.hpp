#pragma once
#include "sum/enrol_oracle.hpp"

namespace pairsum {

/// A list of backends, as a type.
template <class... Backends>
struct backend_list {};

/// Enrols interaction I with every backend of the list, and its reference. A registry of one's own starts empty.
template <class I, class... Backends>
void enrol_everywhere(registry& r, backend_list<Backends...>) {
  (r.enrol_backend(Backends::traits), ...);
  (enrol_summation<Backends, I>(r), ...);
  enrol_oracle<I>(r);
}

}  // namespace pairsum
