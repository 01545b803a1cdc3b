// Plans: any file is read, or refused with one line; what was read reads back as the same.
#include <nlohmann/json.hpp>

#include "harness/plan/study.hpp"
#include "on_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pairsum;
  fuzz::on_file(data, size, [](const std::string& path) {
    constexpr int cores = 4;
    const harness::study_plan plan = harness::parse_plan(harness::load_plan(path), cores);
    const nlohmann::json again = harness::plan_json(plan);
    if (harness::plan_json(harness::parse_plan(again, cores)) != again) fuzz::fault("the plan reads back as another");
    harness::check_plan(plan);
    for (const harness::part_plan& part : plan.parts)
      if (harness::expand(part.request).empty()) fuzz::fault("a plan that can be measured has no points");
  });
  return 0;
}
