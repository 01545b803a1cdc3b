#pragma once
#include <string>
#include <vector>

#include "core/fields.hpp"

namespace pairsum {

/// Column names of a rates struct: "drho", "dv_x", "dv_y", ...
template <class Rates>
std::vector<std::string> rate_names() {
  std::vector<std::string> names;
  std::size_t k = 0;
  fields_detail::each_member<Rates>([&](auto p) {
    constexpr int width = fields_detail::member<decltype(p)>::type::width;
    const std::string name(Rates::names[k++]);
    if (width == 1 && !requires(Rates r) { (r.*p).rows(); }) {
      names.push_back(name);
    } else {
      for (int d = 0; d < width; ++d) names.push_back(name + "_" + "xyz"[d]);
    }
  });
  return names;
}

}  // namespace pairsum
