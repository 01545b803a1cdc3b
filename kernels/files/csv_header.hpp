#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// What a column can hold, and how names say so.
struct csv_quantity {
  std::string_view word;  ///< of --column
  /// Without case, blanks, signs and unit. Where there is an axis, # stands for its letter or number, @ for its letter,
  /// ~ for the letter of its velocity (u, v, w).
  std::string_view spellings;
  std::string_view units;  ///< pairsum's, as names have them
  int axis = -1;
};

const std::vector<csv_quantity>& csv_quantities();

/// A line of words that may name columns.
struct csv_header {
  char separator = ',';
  std::vector<std::string> names;  ///< without quotes; "" where a line begins with or ends in a separator

  /// None: the line has a number, or one field only.
  static std::optional<csv_header> of(std::string_view line);

  /// The column of a quantity: the one hints name, else that with the first spelling of it.
  std::optional<std::size_t> column(const csv_quantity&, const hints&) const;
  std::optional<std::size_t> column_named(std::string_view name) const;
  /// Does it name x, and y or z?
  bool has_positions(const hints&) const;
  /// The names, as a message lists them.
  std::string listed() const;
};

/// A unit in a column's name that is not pairsum's: "mm" of "Pos.x [mm]"; "": none.
std::string_view other_unit(std::string_view name, const csv_quantity&);

/// Is it a name for the time, "TimeStep [s]"?
bool names_time(std::string_view name);

/// A comment's words: "x,y,z" of "# x,y,z".
std::string_view without_comment_sign(std::string_view line);

/// The number that is the whole field. A decimal comma counts, too, where it does not separate fields.
std::optional<double> number_of(std::string_view field);

}  // namespace pairsum::files
