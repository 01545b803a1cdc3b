// CSV: any file is read as numbers, or refused with one line.
#include "particles.hpp"

namespace pairsum::files::formats_of {
file_format csv();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pairsum;
  files::hints told;
  for (const char* const kind : {"", "Type=0,1", "none"}) {
    told.boundary_kind = kind;
    fuzz::read_particle_file(data, size, files::formats_of::csv(), told);
  }
  told.columns = {{"x", "a"}, {"y", "b"}, {"kind", "c"}};
  fuzz::read_particle_file(data, size, files::formats_of::csv(), told);
  return 0;
}
