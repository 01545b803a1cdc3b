#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pairsum::files {

/// Writes the bytes of DualSPHysics' binary files, in either byte order.
struct bi4_bytes {
  std::endian order = std::endian::little;

  template <class T>
  std::string number(T value) const {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }
  std::string count(std::size_t n) const { return number(static_cast<std::uint32_t>(n)); }
  std::string text(std::string_view words) const { return count(words.size()).append(words); }
  std::string block(const std::string& bytes) const { return count(bytes.size()) + bytes; }
  template <class T>
  std::string numbers(const std::vector<T>& values) const {
    std::string bytes;
    for (const T value : values) bytes += number(value);
    return bytes;
  }
  template <class T>
  std::string value(std::string_view name, std::uint32_t type, const std::vector<T>& parts) const {
    return text(name) + number(type) + numbers(parts);
  }
  std::string words(std::string_view name, std::string_view value) const { return text(name) + count(1) + text(value); }
  template <class T>
  std::string array(std::string_view name, std::uint32_t type, std::size_t rows, const std::vector<T>& values) const {
    const std::string bytes = numbers(values);
    return block(text("\nARRAY") + text(name) + count(0) + number(type) + count(rows) + count(bytes.size())) + bytes;
  }
  std::string item(std::string_view name, const std::vector<std::string>& values,
                   const std::vector<std::string>& arrays, const std::vector<std::string>& items = {}) const {
    std::string all;
    if (!values.empty()) all = text("\nVALUES") + count(values.size());
    for (const std::string& v : values) all += v;
    const std::string head = text("\nITEM\n") + text(name) + count(0) + count(0) + text("%.7E") + text("%.15E") +
                             count(arrays.size()) + count(items.size()) + count(all.size());
    all = block(head) + all;
    for (const std::string& one : arrays) all += one;
    for (const std::string& one : items) all += one;
    return all;
  }
  std::string head() const {
    std::string bytes = "#FileJBD JPartDataBi4";
    bytes.resize(58, ' ');
    return bytes + '\n' + '\0' + (order == std::endian::big ? '\1' : '\0') + std::string(3, '\0');
  }
};

}  // namespace pairsum::files
