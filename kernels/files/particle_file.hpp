#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/core/axes.hpp>
#include <pairsum/particles/particle_table.hpp>

namespace pairsum::files {

/// How a value came to be known.
enum class origin { read, given, derived, assumed };  ///< `given`: by an option

/// Their words, in this order.
inline constexpr std::array<std::string_view, 4> origin_words{"read", "given", "derived", "assumed"};
constexpr std::string_view word_of(origin how) { return origin_words[static_cast<std::size_t>(how)]; }

/// A line of the table of what is known about particles of a file: "H", "0.207846 m", derived, "2 h of the header".
struct fact {
  std::string what, value;
  origin how = origin::read;
  std::string from;
};

/// What files do not say, in the words of the command line.
struct hints {
  std::optional<double> H, h, rho0, mass, B;  ///< m, m, kg/m3, kg, Pa
  std::optional<double> support;              ///< H / h; none: what the dialect says, else 2
  std::optional<double> h_quantile;           ///< of a varying h; none: the largest
  std::optional<double> H_in_spacings;        ///< where nothing says H, so many spacings; none: that is an error
  std::optional<int> dim;                     ///< none: as found
  std::optional<std::int64_t> step;           ///< of a file with several; none: the last
  std::string boundary_kind;  ///< "Type=0,1": rows whose column has one of these values; "none"; "": the format's
  std::optional<std::string> periodic;  ///< "x,z", "all" or "none"; none: as the file says, else open
  std::vector<double> box;  ///< low corner and high corner, or the edges of a box at 0; empty: as the file says
  std::map<std::string, std::string> columns;  ///< quantity (x, y, z, vx, vy, vz, rho, m, h, kind) to a column's name
};

/// What one file says, or one group of particles in it, as it stands there: no unit is changed and nothing is made up.
/// A column is empty where there is none, else it has a row per particle.
struct file_content {
  std::string format, dialect;              ///< "hdf5", "gadget"
  std::string label;                        ///< of a group of a file with several: "PartType1"
  std::array<std::vector<double>, 3> x, v;  ///< along the file's axes; empty: not in the file
  std::vector<double> rho, m, h;
  std::vector<particle_kind> kind;
  std::map<std::string, std::vector<double>> others;  ///< columns that hints name (boundary_kind)
  std::optional<int> dim;
  std::optional<double> H, dx, h_of_all, m_of_all, m_of_boundary, rho0, B, gravity, support, time;  ///< of the header
  std::vector<double> box_low, box_high;  ///< m, an entry per axis; empty: not in the file
  std::optional<axes> periodic;
  bool periodic_by_habit = false;   ///< no word of the file says so, but programs of its dialect do it
  bool kinds_by_name = false;       ///< a guess by names of groups
  std::vector<fact> facts;          ///< what else a reader should be told
  std::vector<file_content> more;   ///< further groups of the file, each with columns of its own
  std::vector<std::string> groups;  ///< all groups of particles, also those that are left out
  std::vector<std::string> parts;   ///< all files of a snapshot of several, which were read with this one
};

}  // namespace pairsum::files
