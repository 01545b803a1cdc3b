#include <pairsum/integrators/integrator.hpp>

#include <pairsum/core/names.hpp>

namespace pairsum {

const integrator_entry& find_integrator(std::string_view name) {
  std::vector<std::string_view> names;
  for (const integrator_entry& e : integrator_entries()) {
    if (e.name == name) return e;
    names.push_back(e.name);
  }
  throw unknown_name("integrator", name, names);
}

}  // namespace pairsum
