#include "sum/block_shape.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "core/error.hpp"

namespace pairsum {
namespace {

constexpr std::array<std::string_view, 3> shape_names{"slab", "pencil", "brick"};
constexpr std::array<std::string_view, 3> order_names{"rows", "bundles", "morton"};  // by cell_order
constexpr int widest = 4096;

}  // namespace

block_shape block_shape::parse(const std::string& word) {
  const auto parts = [&] {
    std::array<std::string_view, 4> part{};  // a fourth is one too many
    std::string_view rest = word;
    for (std::string_view& p : part) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      p = rest.substr(0, colon);
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
    return part;
  }();
  const auto name = std::ranges::find(shape_names, parts[0]);
  const bool has_order = std::ranges::count(word, ':') == 2;
  const auto order = has_order ? std::ranges::find(order_names, parts[2]) : order_names.begin();
  int width = 0;
  const char *begin = parts[1].data(), *end = begin + parts[1].size();
  const auto [at, failed] = std::from_chars(begin, end, width);
  if (failed != std::errc() || at != end || std::ranges::count(word, ':') > 2 || name == shape_names.end() ||
      order == order_names.end() || width < 2 || width > widest)
    throw error("block must be auto, slab:N, pencil:N or brick:N with N from 2 to " + std::to_string(widest) +
                " cells, and :bundles or :morton if its cells are not to be in rows, is \"" + word + "\"");
  return {static_cast<int>(name - shape_names.begin()) + 1, width,
          static_cast<cell_order>(order - order_names.begin())};
}

std::string block_shape::word() const {
  std::string w(shape_names[static_cast<std::size_t>(axes) - 1]);
  w.append(":").append(std::to_string(width));
  if (order != cell_order::rows) w.append(":").append(order_names[static_cast<std::size_t>(order)]);
  return w;
}

void check_block(const std::string& word) {
  if (word != "auto") block_shape::parse(word);
}

}  // namespace pairsum
