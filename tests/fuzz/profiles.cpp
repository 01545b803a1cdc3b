// Profiles: any file is read, or refused with one line.
#include "harness/tune/profile_json.hpp"
#include "on_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pairsum;
  fuzz::on_file(data, size, [](const std::string& path) {
    const harness::saved_profile read = harness::read_profile(path);
    if (!harness::is_profile(path)) fuzz::fault("what was read as a profile is none");
    harness::differences(read);
    parse_profile(read.words);
  });
  return 0;
}
