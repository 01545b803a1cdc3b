#include "sum/block_shape.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "core/error.hpp"

namespace pairsum {
namespace {

constexpr std::array<std::string_view, 3> shape_names{"slab", "pencil", "brick"};
constexpr int widest = 4096;

}  // namespace

block_shape block_shape::parse(const std::string& word) {
  const std::size_t colon = word.find(':');
  const auto name = std::ranges::find(shape_names, word.substr(0, colon));
  int width = 0;
  if (name != shape_names.end() && colon != std::string::npos) {
    const char *begin = word.data() + colon + 1, *end = word.data() + word.size();
    const auto [at, failed] = std::from_chars(begin, end, width);
    if (failed != std::errc() || at != end) width = 0;
  }
  if (width < 2 || width > widest)
    throw error("block must be auto, slab:N, pencil:N or brick:N with N from 2 to " + std::to_string(widest) +
                " cells, is \"" + word + "\"");
  return {static_cast<int>(name - shape_names.begin()) + 1, width};
}

block_shape block_shape::fitting(int dim, std::size_t cache_bytes, std::size_t bytes_per_cell) {
  const std::size_t room = (cache_bytes > 0 ? cache_bytes : std::size_t{1} << 20) / 2 / bytes_per_cell;
  int width = 2;
  const auto touched = [&](int w) {
    std::size_t n = 1;
    for (int d = 0; d < dim; ++d) n *= static_cast<std::size_t>(w + 2);
    return n;
  };
  while (width < 16 && touched(2 * width) <= room) width *= 2;
  return {3, width, true};
}

void check_block(const std::string& word) {
  if (word != "auto") block_shape::parse(word);
}

}  // namespace pairsum
