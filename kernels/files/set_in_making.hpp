#pragma once
#include <string>
#include <vector>

#include <pairsum/files/read_particles.hpp>

namespace pairsum::files {

/// What one file of a set says, or one group of its particles.
struct one_file {
  std::string path;
  std::optional<particle_kind> by_path;  ///< what all its particles are, as the path was given
  file_content content;
  std::size_t rows = 0;

  std::string name() const { return path + (content.label.empty() ? "" : ", " + content.label); }
};

/// A set between its files and what is made of them. The functions below are called in this order.
struct set_in_making {
  explicit set_in_making(const hints& options) : told(options) {}

  const hints& told;
  std::vector<one_file> files;
  std::size_t paths = 0;          ///< of which they were read
  std::vector<std::size_t> axes;  ///< of the files, that become x, y and z
  read_set made;

  void tell(std::string what, std::string value, origin how, std::string from) {
    made.facts.push_back({std::move(what), std::move(value), how, std::move(from)});
  }
  int dim() const { return static_cast<int>(axes.size()); }
  /// The first of the files that says it, as `get` finds it in a file's content: an optional.
  template <class Get>
  auto first(Get&& get) const -> decltype(get(files[0].content)) {
    for (const one_file& f : files)
      if (const auto said = get(f.content)) return said;
    return {};
  }
  /// f(file's content, row) for every fluid particle.
  template <class F>
  void each_fluid(F&& f) const {
    for (const one_file& file : files)
      for (std::size_t i = 0; i < file.rows; ++i)
        if (file.content.kind[i] == particle_kind::fluid) f(file.content, i);
  }
  /// All paths, or how many.
  std::string named() const { return paths == 1 ? files[0].path : std::to_string(paths) + " files"; }
};

/// Kinds of the particles, as the path, an option or the file says, in this order.
void choose_kinds(set_in_making& s);
/// Throws pairsum::error unless all numbers are finite, and densities, masses and lengths positive. A column of zeros
/// is none, and so is a wall's 0.
void check_numbers(set_in_making& s);
/// Which axes vary, or are asked for.
void choose_axes(set_in_making& s);
/// Density, mass, velocity and equation of state, spacing.
void complete_columns(set_in_making& s);
/// A length, mass or the like. Errors: what is not positive, with its name.
double positive(const std::string& what, double value);
/// The support radius: of the fluid, by each file's h and its own factor.
void choose_H(set_in_making& s);
/// Moves the columns to the table: fluid first.
void gather(set_in_making& s);
/// The box, its periodic axes, and positions into it.
void choose_domain(set_in_making& s);

}  // namespace pairsum::files
