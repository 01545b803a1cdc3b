#pragma once
#include <array>
#include <string>

namespace pairsum {

/// Some of the axes x, y and z: those along which a domain is periodic, for example.
struct axes {
  std::array<bool, 3> on{};

  static constexpr axes all(int dim) {
    axes a;
    for (int d = 0; d < dim; ++d) a.on[static_cast<std::size_t>(d)] = true;
    return a;
  }
  constexpr bool operator[](int d) const { return on[static_cast<std::size_t>(d)]; }
  constexpr bool any() const { return on[0] || on[1] || on[2]; }
  bool operator==(const axes&) const = default;
  /// "x,z"; "none" without any.
  std::string text() const {
    std::string words;
    for (int d = 0; d < 3; ++d)
      if ((*this)[d]) words += (words.empty() ? "" : ",") + std::string(1, "xyz"[d]);
    return words.empty() ? "none" : words;
  }
};

}  // namespace pairsum
