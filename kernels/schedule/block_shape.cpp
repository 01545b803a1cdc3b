#include <pairsum/schedule/block_shape.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include <pairsum/core/error.hpp>

namespace pairsum {
namespace {

constexpr std::array<std::string_view, 3> shape_names{"slab", "pencil", "brick"};
constexpr int widest = 4096;

}  // namespace

block_shape block_shape::parse(const std::string& word) {
  const std::size_t colon = std::min(word.find(':'), word.size());
  const auto name = std::ranges::find(shape_names, std::string_view(word).substr(0, colon));
  int width = 0;
  const char *begin = word.data() + std::min(colon + 1, word.size()), *end = word.data() + word.size();
  const auto [at, failed] = std::from_chars(begin, end, width);
  if (failed != std::errc() || at != end || name == shape_names.end() || width < 2 || width > widest)
    throw error("block must be auto, slab:N, pencil:N or brick:N with N from 2 to " + std::to_string(widest) +
                " cells, is \"" + word + "\"");
  return {static_cast<int>(name - shape_names.begin()) + 1, width};
}

std::string block_shape::word() const {
  return std::string(shape_names[static_cast<std::size_t>(axes) - 1]) + ":" + std::to_string(width);
}

void check_block(const std::string& word) {
  if (word != "auto") block_shape::parse(word);
}

}  // namespace pairsum
