// An item is a block of its name and counts, a block of its values, then its arrays and items, each with such a block
// first. A block is its length and its bytes; so is a text in it. All lengths and counts have 32 bits.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/bi4_items.hpp>
#include <pairsum/files/shown.hpp>

namespace pairsum::files {
namespace {

constexpr std::size_t head_bytes = 64, byte_order_at = 60;
constexpr std::size_t longest_block = std::size_t{1} << 20;
constexpr int deepest = 8, most_entries = 10'000;

/// A type of values and arrays: its code in the file, bytes of a number, numbers of a value.
struct number_type {
  std::uint32_t code;
  std::size_t bytes;
  int numbers;
  double (*read)(const char*);
};

constexpr std::uint32_t text_code = 1;

template <class T>
double number_at(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return static_cast<double>(value);
}

template <class T>
constexpr number_type type_of(std::uint32_t code, int numbers = 1) {
  return {code, sizeof(T), numbers, number_at<T>};
}

constexpr std::array types{
    type_of<std::int32_t>(2),  // bool
    type_of<std::int8_t>(3),  type_of<std::uint8_t>(4),  type_of<std::int16_t>(5),     type_of<std::uint16_t>(6),
    type_of<std::int32_t>(7), type_of<std::uint32_t>(8), type_of<std::int64_t>(9),     type_of<std::uint64_t>(10),
    type_of<float>(11),       type_of<double>(12),       type_of<std::int32_t>(20, 3), type_of<std::uint32_t>(21, 3),
    type_of<float>(22, 3),    type_of<double>(23, 3),
};

const number_type* type_with(std::uint32_t code) {
  const auto found = std::ranges::find(types, code, &number_type::code);
  return found == types.end() ? nullptr : found;
}

double read_number(const number_type& type, const char* from, bool swapped) {
  std::array<char, sizeof(double)> turned{};
  if (!swapped) return type.read(from);
  std::reverse_copy(from, from + type.bytes, turned.begin());
  return type.read(turned.data());
}

/// What is still to be read of a block.
struct cursor {
  std::string_view rest;
  bool swapped;
  const bi4_items& of;

  const char* skip(std::size_t bytes) {
    if (bytes > rest.size()) of.refuse("is damaged: a text or a value is longer than what holds it");
    const char* from = rest.data();
    rest.remove_prefix(bytes);
    return from;
  }
  std::uint32_t count() {
    return static_cast<std::uint32_t>(read_number(type_of<std::uint32_t>(0), skip(sizeof(std::uint32_t)), swapped));
  }
  std::string text() {
    const std::size_t length = count();
    return {skip(length), length};
  }
};

}  // namespace

bi4_items::bi4_items(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) refuse("cannot be read");
  file_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(file_.tellg());
  const std::string head = bytes(0, head_bytes);
  const auto order = static_cast<unsigned char>(head[byte_order_at]);
  if (!head.starts_with(magic) || order > 1) refuse("is no binary file of DualSPHysics");
  swapped_ = (order == 1) != (std::endian::native == std::endian::big);
  read_item(head_bytes, 0);
}

void bi4_items::refuse(const std::string& what) const { throw error(path_ + ' ' + what); }

std::string bi4_items::bytes(std::uint64_t at, std::uint64_t count) {
  if (at > size_ || count > size_ - at)
    refuse("is cut short: it has " + std::to_string(size_) + " bytes, should have at least " +
           std::to_string(at + count));
  std::string all(count, '\0');
  file_.seekg(static_cast<std::streamoff>(at));
  if (!file_.read(all.data(), static_cast<std::streamsize>(count))) refuse("cannot be read");
  return all;
}

std::string bi4_items::block(std::uint64_t& at) {
  const std::string length = bytes(at, sizeof(std::uint32_t));
  const std::size_t count = cursor{length, swapped_, *this}.count();
  if (count > longest_block)
    refuse("is damaged: a head of " + std::to_string(count) + " bytes at byte " + std::to_string(at));
  at += length.size() + count;
  return bytes(at - count, count);
}

std::uint64_t bi4_items::read_item(std::uint64_t at, int depth) {
  if (depth == deepest) refuse("is damaged: its items nest deeper than " + std::to_string(deepest) + " levels");
  const std::uint64_t begin = at;
  const std::string head = block(at);
  cursor c{head, swapped_, *this};
  if (c.text() != "\nITEM\n") refuse("is damaged: no item begins at byte " + std::to_string(begin));
  c.text();                           // its name
  c.skip(2 * sizeof(std::uint32_t));  // what a listing shows of it
  c.text(), c.text();                 // formats of numbers in a listing
  const std::uint64_t arrays = c.count(), items = c.count(), values_bytes = c.count();
  if (values_bytes > longest_block)
    refuse("is damaged: an item has " + std::to_string(values_bytes) + " bytes of values");
  if (values_bytes > 0) read_values(bytes(at, values_bytes));
  at += values_bytes;
  for (std::uint64_t k = 0; k < arrays + items; ++k) {
    if (++entries_ > most_entries)
      refuse("is damaged: it has more than " + std::to_string(most_entries) + " items and arrays");
    std::uint64_t end = at;
    const std::string next = block(end);
    cursor a{next, swapped_, *this};
    if (a.text() != "\nARRAY") {
      at = read_item(at, depth + 1);
      continue;
    }
    const std::string name = a.text();
    a.skip(sizeof(std::uint32_t));
    const std::uint32_t type = a.count(), rows = a.count(), size = a.count();
    const number_type* known = type_with(type);
    if (size > size_ - end ||
        (known && size != std::uint64_t{rows} * known->bytes * static_cast<unsigned>(known->numbers)))
      refuse("is cut short or damaged: " + shown(name) + " has " + std::to_string(rows) + " rows in " +
             std::to_string(size) + " bytes, and the file " + std::to_string(size_ - end) + " after its head");
    arrays_.emplace(name, bi4_array{type, rows, end});
    at = end + size;
  }
  return at;
}

void bi4_items::read_values(const std::string& block) {
  cursor c{block, swapped_, *this};
  if (c.text() != "\nVALUES") refuse("is damaged: no values where an item has them");
  const std::uint32_t count = c.count();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::string name = c.text();
    const std::uint32_t code = c.count();
    bi4_value value;
    if (code == text_code) {
      value.text = c.text();
    } else {
      const number_type* type = type_with(code);
      if (!type)
        refuse("has " + shown(name) + " of type " + std::to_string(code) + ", which no version is known to write");
      for (int d = 0; d < type->numbers; ++d)
        value.number[static_cast<std::size_t>(d)] = read_number(*type, c.skip(type->bytes), swapped_);
    }
    values_.emplace(name, value);
  }
}

const bi4_value* bi4_items::value(std::string_view name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

const bi4_array* bi4_items::array(std::string_view name) const {
  const auto found = arrays_.find(name);
  return found == arrays_.end() ? nullptr : &found->second;
}

std::vector<std::string> bi4_items::array_names() const {
  std::vector<std::string> names;
  for (const auto& [name, a] : arrays_) names.push_back(shown(name));
  return names;
}

std::vector<std::vector<double>> bi4_items::columns(std::string_view name) {
  constexpr std::size_t at_a_time = 16'384;
  const bi4_array& a = *array(name);
  const number_type* type = type_with(a.type);
  if (!type) refuse("has no numbers in its array " + shown(name));
  const auto width = static_cast<std::size_t>(type->numbers), row_bytes = type->bytes * width;
  std::vector<std::vector<double>> all(width, std::vector<double>(a.rows));
  for (std::size_t begin = 0; begin < a.rows; begin += at_a_time) {
    const std::size_t rows = std::min<std::size_t>(at_a_time, a.rows - begin);
    const std::string piece = bytes(a.at + begin * row_bytes, rows * row_bytes);
    for (std::size_t k = 0; k < rows * width; ++k) {
      const double number = read_number(*type, piece.data() + k * type->bytes, swapped_);
      if (!std::isfinite(number))
        refuse("has a number that is not finite: row " + std::to_string(begin + k / width) + " of its array " +
               shown(name));
      all[k % width][begin + k / width] = number;
    }
  }
  return all;
}

}  // namespace pairsum::files
