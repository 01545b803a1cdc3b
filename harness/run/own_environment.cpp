#include "harness/run/own_environment.hpp"

#include "harness/environment/environment.hpp"
#include "harness/measure/binding.hpp"
#include "harness/measure/counters.hpp"

namespace pairsum::harness {

environment_row own_environment(const study_plan& plan, const std::string& binding) {
  return describe_environment(plan.study, thread_binding(binding).description(), counters().description());
}

}  // namespace pairsum::harness
