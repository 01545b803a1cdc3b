// What this build of the library holds: the words of kernels/registry.def, less those that options leave out. An
// explicit list, for objects that register themselves vanish from static libraries.
#include <pairsum/cases/case.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/formula/words.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/registry.hpp>

// What the words stand for, defined by the files of their names.
#define BACKEND(word)   \
  namespace backends {  \
  backend_entry word(); \
  }
#define DECLARE(word, D, precision) \
  void formulas_of_##word(place<D, precisions::precision>, std::vector<formula_entry>&);
#define FORMULA(word, kind) PAIRSUM_EACH_PLACE(DECLARE, word)
#define SMOOTHING(word)
#define CASE(word)     \
  namespace cases_of { \
  case_entry word();   \
  }
#define INTEGRATOR(word)     \
  namespace integrators_of { \
  integrator_entry word();   \
  }
namespace pairsum {
#include <pairsum/registry.def>
}
#undef BACKEND
#undef FORMULA
#undef SMOOTHING
#undef CASE
#undef INTEGRATOR

namespace pairsum {
namespace {

constexpr std::string_view dims = PAIRSUM_BUILT_DIMS, precision_list = PAIRSUM_BUILT_PRECISIONS,
                           interactions = PAIRSUM_BUILT_INTERACTIONS, smoothings = PAIRSUM_BUILT_SMOOTHINGS;

}  // namespace

void add_library(registry& r) {
  const auto unless = [&](bool built, const char* kind, const char* word, const char* option) {
    if (!built) r.add_missing({kind, word, option});
  };
  std::vector<formula_entry> formulas;
  bool smoothed = false;
#define BACKEND(word) r.add(backends::word());
#define ADD(word, D, precision)                                                                                      \
  if constexpr (is_in(interactions, #word) && is_in(dims, #D) && is_in(precision_list, precisions::precision::name)) \
    formulas_of_##word(place<D, precisions::precision>(), formulas);
#define FORMULA(word, kind)                                                         \
  PAIRSUM_EACH_PLACE(ADD, word)                                                     \
  unless(is_in(interactions, #word), "interaction", #word, "PAIRSUM_INTERACTIONS"); \
  smoothed = smoothed || (is_in(interactions, #word) && std::string_view(#kind) == "smoothed");
#define SMOOTHING(word)                                                              \
  unless(is_in(smoothings, #word), "smoothing kernel", #word, "PAIRSUM_SMOOTHINGS"); \
  if (!smoothed) unless(!is_in(smoothings, #word), "smoothing kernel", #word, "PAIRSUM_INTERACTIONS");
#define CASE(word)
#define INTEGRATOR(word)
#include <pairsum/registry.def>
#undef BACKEND
#undef FORMULA
#undef SMOOTHING
#undef CASE
#undef INTEGRATOR
  for (const char* const dim : {"1", "2", "3"}) unless(is_in(dims, dim), "dimension", dim, "PAIRSUM_DIMS");
  for (const char* const precision : {"double", "float", "mixed"})
    unless(is_in(precision_list, precision), "precision", precision, "PAIRSUM_PRECISIONS");
  // By place, as they are listed.
  for (const int dim : {1, 2, 3})
    for (const std::string_view precision : {"double", "float", "mixed"})
      for (const formula_entry& f : formulas)
        if (f.words.dim == dim && f.words.precision == precision) r.add(f);
}

#define BACKEND(word)
#define FORMULA(word, kind)
#define SMOOTHING(word)
#define CASE(word) cases_of::word(),
#define INTEGRATOR(word)
const std::vector<case_entry>& case_entries() {
  static const std::vector<case_entry> all{
#include <pairsum/registry.def>
  };
  return all;
}
#undef CASE
#undef INTEGRATOR
#define CASE(word)
#define INTEGRATOR(word) integrators_of::word(),
const std::vector<integrator_entry>& integrator_entries() {
  static const std::vector<integrator_entry> all{
#include <pairsum/registry.def>
  };
  return all;
}

}  // namespace pairsum
