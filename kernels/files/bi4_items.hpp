#pragma once
// The container of DualSPHysics' binary files (.bi4 and its kin): a head of 64 bytes, then an item, which has values,
// arrays and further items. Nothing is believed that the file is too short for.
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum::files {

/// A value of an item: text, or one number, or three.
struct bi4_value {
  std::string text;
  std::array<double, 3> number{};
};

/// An array of an item: its type's code, how many rows it has, and where they begin in the file.
struct bi4_array {
  std::uint32_t type = 0, rows = 0;
  std::uint64_t at = 0;
};

/// What the items of a file hold, as one list of values and one of arrays; of several with one name, the first.
class bi4_items {
 public:
  static constexpr std::string_view magic = "#File";

  /// Reads all but the rows of arrays. Errors, each one line that begins with the path: no such file, a file cut short,
  /// items that nest deeper or hold more than particle files do.
  explicit bi4_items(const std::string& path);

  /// Null: there is none of that name.
  const bi4_value* value(std::string_view name) const;
  const bi4_array* array(std::string_view name) const;
  std::vector<std::string> array_names() const;

  /// The columns of an array, one or three. Errors: no numbers; a number that is not finite.
  std::vector<std::vector<double>> columns(std::string_view name);
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string bytes(std::uint64_t at, std::uint64_t count);
  std::string block(std::uint64_t& at);
  std::uint64_t read_item(std::uint64_t at, int depth);
  void read_values(const std::string& block);

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  bool swapped_ = false;  ///< the file's byte order is not this machine's
  int entries_ = 0;
  std::map<std::string, bi4_value, std::less<>> values_;
  std::map<std::string, bi4_array, std::less<>> arrays_;
};

}  // namespace pairsum::files
