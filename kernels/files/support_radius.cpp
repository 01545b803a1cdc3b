// The support radius of particles of files.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/set_in_making.hpp>

namespace pairsum::files {
namespace {

constexpr double widest = 1.5;       ///< largest support radius over smallest that one for all may stand for
constexpr double usual_support = 2;  ///< H / h where nothing says it

/// What files say: a support radius for each particle, or one of a header, and h times which factors it is.
struct radii {
  std::vector<double> H;
  std::set<double> factors;
  double least_h = std::numeric_limits<double>::infinity(), most_h = 0;  ///< of columns

  bool of_columns() const { return most_h > 0; }
  void add(double factor, double h) {
    H.push_back(factor * h);
    factors.insert(factor);
  }
};

/// A header's H, or its h, which needs a factor.
void add_header(const set_in_making& s, const one_file& f, radii& all) {
  if (f.content.H)
    all.add(1, positive(f.name() + ": H of the header", *f.content.H));
  else if (f.content.h_of_all)
    all.add(s.told.support.value_or(f.content.support.value_or(usual_support)),
            positive(f.name() + ": h of the header", *f.content.h_of_all));
}

/// A column's h, which a kernel must be known for.
void add_column(const set_in_making& s, const one_file& f, radii& all) {
  const auto factor = s.told.support ? s.told.support : f.content.support;
  if (!factor)
    throw error(f.name() +
                ": the smoothing kernel is unknown, so h does not say the support radius; --support does, as H / h, "
                "or --H");
  all.factors.insert(*factor);
  for (std::size_t i = 0; i < f.rows; ++i) {
    if (f.content.kind[i] != particle_kind::fluid) continue;
    const double h = f.content.h[i];
    all.H.push_back(*factor * h);
    all.least_h = std::min(all.least_h, h);
    all.most_h = std::max(all.most_h, h);
  }
}

std::string spread(double low, double high) {
  return number_text(low) + " to " + number_text(high) + ", a factor of " +
         number_text(std::round(high / low * 1000) / 1000);
}

}  // namespace

void choose_H(set_in_making& s) {
  const hints& told = s.told;
  const auto take = [&](double value, origin how, const std::string& from) {
    s.made.initial.H = value;
    s.tell("H", number_text(value), how, from);
  };
  if (told.support) positive("--support", *told.support);
  if (told.H) return take(positive("--H", *told.H), origin::given, "--H");
  if (told.h) {
    const auto said = s.first([](const file_content& c) { return c.support; });
    const double factor = told.support ? *told.support : said.value_or(usual_support);
    return take(factor * positive("--h", *told.h), origin::given,
                number_text(factor) + " h" +
                    (told.support ? " by --support"
                     : said       ? ""
                                  : ", assumed"));
  }
  radii all;
  const auto has_fluid = [](const one_file& f) {
    return std::ranges::find(f.content.kind, particle_kind::fluid) != f.content.kind.end();
  };
  for (const one_file& f : s.files)
    if (has_fluid(f) && !f.content.h.empty() && !f.content.H)
      add_column(s, f, all);
    else if (has_fluid(f))
      add_header(s, f, all);
  if (all.H.empty())
    for (const one_file& f : s.files) add_header(s, f, all);
  if (all.H.empty() && told.H_in_spacings && !told.support && !told.h_quantile)
    return take(*told.H_in_spacings * s.made.dx, origin::assumed,
                number_text(*told.H_in_spacings) + " spacings; nothing says it, --H does");
  if (all.H.empty())
    throw error(s.named() +
                ": nothing says the support radius; --H does, in m, or --h with --support; the spacing is " +
                number_text(s.made.dx) + " m");
  const auto [low, high] = std::ranges::minmax(all.H);
  if (high > widest * low)
    throw error(s.named() + ": the support radius goes from " + spread(low, high) +
                ", and pairsum has one for all particles, so " + number_text(widest) +
                " is the most; --H takes a length all the same");
  const double q = told.h_quantile.value_or(1);
  if (!(q > 0 && q <= 1)) throw error("--h-quantile is " + number_text(q) + ", should be above 0 and at most 1");
  if (all.of_columns()) s.tell("h", spread(all.least_h, all.most_h), origin::read, "the column h of the fluid");
  const double factor = *all.factors.begin();
  const std::string times = all.factors.size() > 1 ? "h times what each file says" : number_text(factor) + " h";
  const std::string which = q == 1 ? ", of the largest" : ", of the quantile " + number_text(q);
  const auto at = all.H.begin() + static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(all.H.size())) - 1);
  std::ranges::nth_element(all.H, at);
  if (!all.of_columns() && all.factors == std::set{1.0}) return take(*at, origin::read, "the header");
  take(*at, origin::derived, times + (all.of_columns() || all.factors.size() > 1 ? which : " of the header"));
}

}  // namespace pairsum::files
