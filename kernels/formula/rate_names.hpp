#pragma once
#include <string>
#include <vector>

#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// Column names of what interaction I sums: "drho", "dv_x", "dv_y", ... from rates::names, or from I::rate_name if its
/// rates are a single scalar or vec.
template <class I>
std::vector<std::string> rate_names() {
  using rates = rates_of<I>;
  std::vector<std::string> names;
  const auto append = [&](std::string_view name, int width, bool is_vec) {
    if (!is_vec) return names.emplace_back(name), void();
    for (int d = 0; d < width; ++d) names.push_back(std::string(name) + "_" + "xyz"[d]);
  };
  if constexpr (fields_detail::is_struct<rates>) {
    std::size_t k = 0;
    fields_detail::each_member<rates>([&](auto p) {
      append(
          rates::names[k++], fields_detail::member<decltype(p)>::type::width, requires(rates r) { (r.*p).rows(); });
    });
  } else {
    append(
        I::rate_name, field_count<rates>, requires(rates r) { r.rows(); });
  }
  return names;
}

}  // namespace pairsum
