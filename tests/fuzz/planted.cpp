// A control: reads behind the end of what starts with "pair".
#include <cstddef>
#include <cstdint>
#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return size > 4 && std::memcmp(data, "pair", 4) == 0 && data[size] == 7 ? -1 : 0;
}
