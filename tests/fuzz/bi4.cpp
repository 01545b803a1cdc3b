// DualSPHysics' binary files: any file is read as numbers, or refused with one line.
#include "particles.hpp"

namespace pairsum::files::formats_of {
file_format bi4();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pairsum;
  files::hints told;
  for (const char* const kind : {"", "Idp=0,1", "none"}) {
    told.boundary_kind = kind;
    fuzz::read_particle_file(data, size, files::formats_of::bi4(), told);
  }
  return 0;
}
