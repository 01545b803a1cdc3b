#include <cstring>

#include "ranked_scene.hpp"

namespace pairsum::test_kit {
namespace {
const ranks::job* job_of_main = nullptr;
}  // namespace

const ranks::job& this_job() { return *job_of_main; }

}  // namespace pairsum::test_kit

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const pairsum::ranks::job job;
  pairsum::test_kit::job_of_main = &job;
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (job.rank() > 0) delete listeners.Release(listeners.default_result_printer());
  const double failed = RUN_ALL_TESTS();
  for (const auto& other : job.gather(std::vector<double>{failed}))
    if (other[0] != 0) return 1;
  return 0;
}
