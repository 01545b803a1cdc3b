#pragma once
#include <pairsum/build_word.hpp>

namespace pairsum {

class registry;

/// What a shared object offers to a program of the same build: backends, formulas. The build is named first, now and
/// later, so that an object of another build can be told.
struct plugin {
  const char* build;       ///< build_word
  const char* name;        ///< what rows of measurements call it
  void (*add)(registry&);  ///< adds all it has to the program's registry; registry::instance() is the object's own
};

}  // namespace pairsum

/// Makes the shared object that this is compiled into plug-in `word`, which offers what `add_function(registry&)` adds.
#define PAIRSUM_PLUGIN(word, add_function)                                        \
  extern "C" [[gnu::visibility("default")]] const pairsum::plugin pairsum_plugin; \
  const pairsum::plugin pairsum_plugin{pairsum::build_word, #word, add_function};
