#include <pairsum/files/hdf5_dialects.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

// clang-format off
constexpr hdf5_dialect gadget{
    .name = "gadget", .groups = "PartType*", .meant = groups_meant::first,
    .x = "Coordinates", .v = "Velocities|Velocity", .rho = "Density|Densities", .m = "Masses|Mass",
    .h = "SmoothingLength|SmoothingLengths", .kind = "Kind",
    .time = "Header@Time", .dim = "Header@Dimension",
    .edges = "Header@BoxSize", .low = "Header@BoxLow", .high = "Header@BoxHigh",
    .axes = "Header@Periodic|RuntimePars@PeriodicBoundariesOn|Parameters@InitialConditions:periodic",
    .gamma = "HydroScheme@Kernel gamma|Parameters@Kernel gamma",
    .length_is = "Header@SmoothingLengthIs", .function = "HydroScheme@Kernel function",
    .masses = "Header@MassTable", .counts = "Header@NumPart_ThisFile", .files = "Header@NumFilesPerSnapshot",
    .rho0 = "Header@Rho0", .B = "Header@B", .H = "Header@SupportRadius",
    .gravity = "Header@Gravity", .dx = "Header@Spacing",
    .support = 1, .periodic = true};

constexpr hdf5_dialect swift = [] {
  hdf5_dialect d = gadget;
  d.name = "swift";
  d.marks = "HydroScheme|RuntimePars|PartType0/SmoothingLengths|PartType0/Densities|Parameters@Kernel gamma";
  d.support = 0;  // by its kernel alone
  return d;
}();

constexpr hdf5_dialect pysph{
    .name = "pysph", .groups = "particles/*/arrays", .meant = groups_meant::all,
    .x = "x,y,z", .v = "u,v,w", .rho = "rho", .m = "m", .h = "h",
    .time = "solver_data@t"};

constexpr hdf5_dialect h5part{
    .name = "h5part", .groups = "Step#*", .meant = groups_meant::last,
    .x = "x,y,z|coords_0,coords_1,coords_2", .v = "vx,vy,vz|u,v,w", .rho = "rho|density", .m = "m|mass",
    .h = "h|hsml|smoothing_length", .kind = "kind",
    .time = "@time|@TimeValue", .limits = "@box", .axes = "@boundaryType|@boundaryTypes"};

constexpr hdf5_dialect sph_exa = [] {
  hdf5_dialect d = h5part;
  d.name = "sph_exa";
  d.marks = "@box";
  return d;
}();

constexpr hdf5_dialect vtkhdf{
    .name = "vtkhdf", .groups = "VTKHDF", .meant = groups_meant::last,
    .x = "Points", .v = "PointData/Velocities|PointData/Velocity|PointData/Vel|PointData/v",
    .rho = "PointData/Density|PointData/Densities|PointData/Rhop|PointData/rho", .m = "PointData/Masses|PointData/Mass|PointData/m",
    .h = "PointData/SmoothingLength|PointData/SmoothingLengths|PointData/h", .kind = "PointData/Kind"};
// clang-format on

constexpr std::array dialects{swift, gadget, pysph, sph_exa, h5part, vtkhdf};

struct kernel_gamma {
  std::string_view begins;
  std::array<double, 3> in;  ///< 1D, 2D, 3D
};
constexpr std::array<kernel_gamma, 6> gammas{{{"cubic spline", {1.732051, 1.778002, 1.825742}},
                                              {"quartic spline", {1.936492, 1.977173, 2.018932}},
                                              {"quintic spline", {2.121321, 2.158131, 2.195775}},
                                              {"wendland c2", {1.620185, 1.897367, 1.936492}},
                                              {"wendland c4", {1.936492, 2.171239, 2.207940}},
                                              {"wendland c6", {2.207940, 2.415230, 2.449490}}}};

/// Plurals but for their s. The first of these that a name has counts.
struct kind_words {
  kind_word kind;
  std::array<std::string_view, 11> words;
};
constexpr std::array<kind_words, 3> kinds_by_name{
    {{kind_word::fluid, {"fluid", "water", "liquid", "gas", "oil", "air"}},
     {kind_word::boundary,
      {"boundary", "boundarie", "wall", "solid", "obstacle", "tank", "container", "floor", "bed", "gate", "box"}},
     {kind_word::body, {"body", "bodie", "rigid", "floating"}}}};

std::string lower(std::string_view text) {
  std::string all(text);
  std::ranges::transform(all, all.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return all;
}

}  // namespace

std::span<const hdf5_dialect> hdf5_dialects() { return dialects; }

double gamma_of(std::string_view function, int dim) {
  const std::string word = lower(function);
  for (const kernel_gamma& g : gammas)
    if (word.starts_with(g.begins) && dim >= 1 && dim <= 3) return g.in[static_cast<std::size_t>(dim - 1)];
  return 0;
}

kind_word kind_named(std::string_view group) {
  std::string text;
  for (const char c : group) {  // WaterBody has two words
    const bool begins = std::isupper(static_cast<unsigned char>(c)) != 0 && !text.empty() &&
                        std::islower(static_cast<unsigned char>(text.back())) != 0;
    text += begins ? std::string{' ', c} : std::string{c};
  }
  text = lower(text);
  std::ranges::replace_if(
      text, [](unsigned char c) { return !std::isalpha(c); }, ' ');
  std::vector<std::string_view> words = split(text, ' ');
  std::erase(words, "");
  for (std::string_view& w : words)
    if (w.size() > 3 && w.ends_with('s') && !w.ends_with("gas")) w.remove_suffix(1);
  for (const kind_words& one : kinds_by_name)
    if (std::ranges::any_of(words,
                            [&](std::string_view w) { return std::ranges::find(one.words, w) != one.words.end(); }))
      return one.kind;
  return kind_word::none;
}

}  // namespace pairsum::files
