#include <pairsum/sum/lane_rows.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/sum/mixed_unit.hpp>

namespace pairsum {
namespace {

constexpr double turn = 4294967296;  ///< of whole numbers modulo 2^32
#ifdef __FP_FAST_FMA
constexpr bool scalar_fuses = true;
#else
constexpr bool scalar_fuses = false;
#endif

template <int D, class R>
bool in_reach(const positions<D, R>& x, std::uint32_t i, std::uint32_t j, R reach2) {
  return norm2<D, R>(x.point_of(i) - x[j]) < reach2;
}

/// The domain's longest edge along the axes that are periodic, or along those that are not, in units of the cutoff; 0
/// without any.
double widest(const setup& s, double cutoff, bool periodic) {
  double longest = 0;
  for (std::size_t d = 0; d < s.omega_low.size(); ++d)
    if (s.periodic.on[d] == periodic) longest = std::max(longest, s.omega_high[d] - s.omega_low[d]);
  return longest / cutoff;
}

}  // namespace

lane_tolerances lane_tolerances::of(const setup& s, double cutoff, bool mixed, double u, double value_u) {
  constexpr double unfolded = 2000;
  lane_tolerances t;
  const double open = widest(s, cutoff, false), around = widest(s, cutoff, true);
  double component = 1.0 / places_per_reach + std::max(open, around) * 0x1p-51;  // in units of the cutoff
  component += around * (1.01 / turn + u);
  t.excess = static_cast<float>(2 * std::sqrt(3.0) * component + 3 * component * component);
  for (std::size_t d = 0; d < s.omega_low.size(); ++d) {
    const double edge = s.omega_high[d] - s.omega_low[d];
    t.mixed_unit[d] = s.periodic.on[d] ? pairsum::mixed_unit(s.constants.H, edge) : pairsum::mixed_unit(s.constants.H);
  }
  const bool all_are_near = t.excess < 8 && open < unfolded;
  t.tie = !mixed || all_are_near ? 16 * value_u : std::numeric_limits<double>::infinity();
  return t;
}

template <int D, class R>
lane_rows<D, R>::lane_rows(const setup& s, const lane_layout& layout, bool lanes_fuse, double skin)
    : layout_(layout),
      cutoff_(s.constants.H * (1 + skin)),
      boundary_reach_(layout.boundary_reach > 0 ? (layout.boundary_reach + skin) / (1 + skin) : 0) {
  const lane_tolerances allowed =
      lane_tolerances::of(s, cutoff_, layout.mixed, static_cast<double>(std::numeric_limits<R>::epsilon()),
                          layout.value == 4 ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                            : std::numeric_limits<double>::epsilon());
  excess_ = allowed.excess;
  const bool rounds_alike = !layout.mixed && (D == 1 || lanes_fuse == scalar_fuses);
  view_.periodic = s.periodic.any();
  view_.in_reach = rounds_alike ? nullptr : &in_reach<D, R>;
  view_.tie = allowed.tie;
  std::copy_n(allowed.mixed_unit.begin(), D, view_.mixed_unit.begin());
}

template <int D, class R>
void lane_rows<D, R>::prepare(problem<D, R>& p, const team& t) {
  constexpr std::size_t most_in_float = 0x7fffffff;  // numbers of particles are lanes as wide as values
  p.spare_rows = spare_rows;
  const std::size_t rows = p.rate_rows(), all = p.count + (rows - p.fluid_count);
  if (layout_.value == 4 && all > most_in_float)
    throw error("vector units take at most 2^31 - 1 particles in float or mixed precision, got " +
                std::to_string(p.count));
  rows_.resize(rows * layout_.stride);
  view_.rows = rows_.data();
  for (int d = 0; d < D; ++d) view_.origin[d] = p.x.omega.edge[d] > 0 && p.count > 0 ? p.x.column[d][0] : R(0);
  for (auto& column : place_) column.resize(p.count + place_room);
  t.for_pieces(p.count, [&](std::size_t begin, std::size_t end, std::size_t) { fill_places(p, begin, end); });
  for (std::size_t i = p.fluid_count; i < rows; ++i) {
    std::byte* const row = rows_.data() + i * layout_.stride;
    if (layout_.value == 4)
      std::fill_n(reinterpret_cast<float*>(row), layout_.rates_at / 4, std::numeric_limits<float>::quiet_NaN());
    else
      std::fill_n(reinterpret_cast<double*>(row), layout_.rates_at / 8, std::numeric_limits<double>::quiet_NaN());
    std::fill_n(reinterpret_cast<R*>(row + layout_.rates_at), (layout_.stride - layout_.rates_at) / sizeof(R), R(0));
  }
  p.is_zero = true;
  rates_begin_ = rows_.data() + layout_.rates_at;
  p.lane = &view_;
  p.u = {&rates_begin_, layout_.stride};
  lane_places<D>& places = p.places;
  places.excess = excess_;
  places.boundary_reach = static_cast<float>(boundary_reach_);
  places.periodic = view_.periodic;
  for (int d = 0; d < D; ++d) {
    places.place[d] = place_[d].data();
    if (!view_.periodic) continue;
    const double edge = p.x.omega.edge[d] / cutoff_ * places_per_reach;
    places.place_size[d] = edge > 0 ? static_cast<float>(edge / turn) : 1.0F;
    places.half_edge[d] = edge > 0 ? static_cast<float>(edge / 2) : std::numeric_limits<float>::infinity();
  }
}

/// From the first particle, so that a domain far from 0 keeps its digits. The edge of a periodic axis is 2^32.
template <int D, class R>
void lane_rows<D, R>::fill_places(const problem<D, R>& p, std::size_t begin, std::size_t end) {
  if (begin == end) return;
  for (int d = 0; d < D; ++d) {
    const R* const x = p.x.column[d];
    const double first = x[0], edge = p.x.omega.edge[d], scale = edge > 0 ? turn / edge : places_per_reach / cutoff_;
    for (std::size_t i = begin; i < end; ++i) place_[d][i] = modulo_2_32((static_cast<double>(x[i]) - first) * scale);
  }
}

#define PAIRSUM_LANE_ROWS(D, R) template class lane_rows<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_LANE_ROWS)

}  // namespace pairsum
