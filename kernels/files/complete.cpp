// What is made of what files say, but for kinds, support radius and domain: axes, density, mass.
#include <algorithm>
#include <cmath>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/nearest_spacing.hpp>
#include <pairsum/files/set_in_making.hpp>

namespace pairsum::files {
namespace {

std::string row_text(const one_file& f, std::size_t i) { return f.name() + ": particle " + std::to_string(i + 1); }

template <class Column>
double median_of(Column values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Values of the fluid, value(file, row).
template <class F>
std::vector<double> of_fluid(const set_in_making& s, F&& value) {
  std::vector<double> all;
  std::size_t n = 0;
  for (const one_file& f : s.files)
    n += static_cast<std::size_t>(std::ranges::count(f.content.kind, particle_kind::fluid));
  all.reserve(n);
  s.each_fluid([&](const file_content& c, std::size_t i) { all.push_back(value(c, i)); });
  return all;
}

/// The median distance of fluid particles to their nearest neighbours.
double spacing_of_fluid(const set_in_making& s) {
  std::vector<std::vector<double>> x;
  for (const std::size_t d : s.axes)
    x.push_back(of_fluid(s, [d](const file_content& c, std::size_t i) { return c.x[d][i]; }));
  std::vector<const std::vector<double>*> columns;
  for (const std::vector<double>& one : x) columns.push_back(&one);
  return nearest_spacing(columns);
}

}  // namespace

double positive(const std::string& what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw error(what + " is " + number_text(value) + ", should be a positive number");
  return value;
}

void check_numbers(set_in_making& s) {
  for (one_file& f : s.files) {
    file_content& c = f.content;
    const auto check = [&](std::vector<double>& column, const char* what, bool must_be_positive,
                           bool of_fluid_alone = false) {
      if (must_be_positive && std::ranges::all_of(column, [](double a) { return a == 0; }))
        std::vector<double>().swap(column);
      for (std::size_t i = 0; i < column.size(); ++i)
        if (c.kind[i] != particle_kind::fluid && (of_fluid_alone || (must_be_positive && column[i] == 0)))
          continue;  // a wall that has none
        else if (!std::isfinite(column[i]) || (must_be_positive && !(column[i] > 0)))
          throw error(row_text(f, i) + " has " + what + " = " + number_text(column[i]) + ", should be " +
                      (must_be_positive ? "positive and finite" : "finite"));
    };
    for (std::size_t d = 0; d < 3; ++d) {
      const char* const names[][2] = {{"x", "vx"}, {"y", "vy"}, {"z", "vz"}};
      check(c.x[d], names[d][0], false);
      check(c.v[d], names[d][1], false);
    }
    check(c.rho, "density", true);
    check(c.m, "mass", true);
    if (!s.told.H && !s.told.h) check(c.h, "h", true, true);
  }
}

void choose_axes(set_in_making& s) {
  std::vector<std::size_t> there, varying;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto missing = std::ranges::count_if(s.files, [&](const one_file& f) { return f.content.x[d].empty(); });
    if (missing == static_cast<std::ptrdiff_t>(s.files.size())) continue;
    if (missing > 0) throw error(s.named() + ": some have a column " + "xyz"[d] + ", others have none");
    there.push_back(d);
    const double first = s.files[0].content.x[d][0];
    if (std::ranges::any_of(s.files, [&](const one_file& f) {
          return std::ranges::any_of(f.content.x[d], [&](double a) { return a != first; });
        }))
      varying.push_back(d);
  }
  const auto said = s.first([](const file_content& c) { return c.dim; });
  const std::optional<int> dim = s.told.dim ? s.told.dim : said;
  const char* const who = s.told.dim ? "--dim" : "the header";
  if (dim && (*dim < 1 || *dim > 3))
    throw error(std::string(who) + " says " + std::to_string(*dim) + " dimensions, should be 1, 2 or 3");
  s.axes = dim ? there : varying.empty() ? there : varying;
  if (dim) {
    const auto n = static_cast<std::size_t>(*dim);
    if (varying.size() > n || there.size() < n)
      throw error(s.named() + ": " + who + " says " + std::to_string(n) + "D, but there are " +
                  std::to_string(there.size()) + " columns of positions, of which " + std::to_string(varying.size()) +
                  " vary");
    // The constant ones go, the last first.
    for (std::size_t k = s.axes.size(); k-- > 0 && s.axes.size() > n;)
      if (std::ranges::find(varying, s.axes[k]) == varying.end())
        s.axes.erase(s.axes.begin() + static_cast<std::ptrdiff_t>(k));
  }
  std::string left, kept;
  for (const std::size_t d : there) {
    const bool stays = std::ranges::find(s.axes, d) != s.axes.end();
    (stays ? kept : left) += std::string(stays ? kept.empty() ? "" : ", " : left.empty() ? "" : ", ") + "xyz"[d];
  }
  const bool same = left.empty() && s.axes.back() + 1 == s.axes.size();
  const std::string why = (left.empty() ? "" : left + " is constant; ") + "the columns " + kept +
                          (same                ? ""
                           : s.axes.size() > 1 ? " are x and y"
                                               : " are x");
  s.tell("dim", std::to_string(s.dim()),
         s.told.dim     ? origin::given
         : said         ? origin::read
         : left.empty() ? origin::read
                        : origin::derived,
         (s.told.dim ? "--dim; "
          : said     ? "the header; "
                     : "") +
             why);
}

void complete_columns(set_in_making& s) {
  const hints& told = s.told;
  tait& eos = s.made.initial.eos;
  double density_sum = 0, with_density = 0;
  s.each_fluid([&](const file_content& c, std::size_t i) {
    if (c.rho.empty()) return;
    density_sum += c.rho[i];
    ++with_density;
  });
  const auto header_dx = s.first([](const file_content& c) { return c.dx; });
  double& dx = s.made.dx;
  const auto nearest = [&] {
    if (dx == 0 && header_dx) {
      dx = positive("the spacing of the header", *header_dx);
      s.tell("dx", number_text(dx), origin::read, "the header");
    } else if (dx == 0) {
      dx = spacing_of_fluid(s);
      if (!(dx > 0))
        throw error(s.named() + ": too few particles to derive their spacing; --mass and --rho0 say mass and density");
      s.tell("dx", number_text(dx), origin::derived, "median distance to the nearest neighbour");
    }
    return std::pow(dx, s.dim());
  };
  const auto header_rho0 = s.first([](const file_content& c) { return c.rho0; });
  if (told.rho0) {
    eos.rho0 = positive("--rho0", *told.rho0);
    s.tell("rho0", number_text(eos.rho0), origin::given, "--rho0");
  } else if (header_rho0) {
    eos.rho0 = positive("rho0 of the header", *header_rho0);
    s.tell("rho0", number_text(eos.rho0), origin::read, "the header");
  } else if (with_density > 0) {
    eos.rho0 = density_sum / with_density;
    s.tell("rho0", number_text(eos.rho0), origin::derived, "mean density of the fluid");
  } else {
    std::vector<double> masses;
    if (told.mass) masses = {*told.mass};
    s.each_fluid([&](const file_content& c, std::size_t i) {
      if (!told.mass && (!c.m.empty() || c.m_of_all)) masses.push_back(c.m.empty() ? *c.m_of_all : c.m[i]);
    });
    if (masses.empty())
      throw error(s.named() + ": there is neither density nor mass; --rho0 says the density, 1000 for water in kg/m3");
    eos.rho0 = positive("the density of masses and spacing", median_of(std::move(masses)) / nearest());
    s.tell("rho0", number_text(eos.rho0), origin::derived,
           "median mass of the fluid over dx^" + std::to_string(s.dim()));
  }
  for (one_file& f : s.files) {
    std::vector<double>& rho = f.content.rho;
    const auto walls = std::ranges::count(rho, 0.0);
    if (!rho.empty() && walls == 0) continue;
    s.tell(
        "density", number_text(eos.rho0), origin::assumed,
        f.name() + (rho.empty() ? " has none: rho0" : ": " + std::to_string(walls) + " of the walls have none: rho0"));
    rho.resize(f.rows, 0.0);
    std::ranges::replace(rho, 0.0, eos.rho0);
  }
  for (one_file& f : s.files) {
    if (told.mass) f.content.m.clear();
    if (!f.content.m.empty() && std::ranges::count(f.content.m, 0.0) == 0) continue;
    const auto header_boundary = f.content.m_of_boundary;
    const bool given = told.mass.has_value(), read = !given && f.content.m_of_all.has_value();
    const double fluid = positive("the mass", given ? *told.mass : read ? *f.content.m_of_all : eos.rho0 * nearest());
    const double boundary = !given && header_boundary ? positive("the mass of boundary", *header_boundary) : fluid;
    const std::string of_walls = f.content.m.empty() ? "" : ", of walls that have none";
    f.content.m.resize(f.rows, 0.0);
    for (std::size_t i = 0; i < f.rows; ++i)
      if (f.content.m[i] == 0) f.content.m[i] = f.content.kind[i] == particle_kind::fluid ? fluid : boundary;
    s.tell("mass", number_text(fluid) + (boundary == fluid ? "" : ", of boundary " + number_text(boundary)),
           given  ? origin::given
           : read ? origin::read
                  : origin::derived,
           (given  ? "--mass"
            : read ? "the header"
                   : "rho0 dx^" + std::to_string(s.dim())) +
               of_walls);
  }
  for (one_file& f : s.files) {
    std::string none;
    for (const std::size_t d : s.axes)
      if (f.content.v[d].empty()) {
        f.content.v[d].assign(f.rows, 0.0);
        none += (none.empty() ? "" : ", ") + std::string(1, "xyz"[d]);
      }
    if (!none.empty()) s.tell("velocity", "0", origin::assumed, f.name() + " has none along " + none);
  }
  if (dx == 0 && header_dx) nearest();
  if (dx == 0) {
    const auto volume = [](const file_content& c, std::size_t i) { return c.m[i] / c.rho[i]; };
    dx = std::pow(median_of(of_fluid(s, volume)), 1.0 / s.dim());
    s.tell("dx", number_text(dx), origin::derived,
           "median of (mass/density)^(1/" + std::to_string(s.dim()) + ") of the fluid");
  }
  const auto header_B = s.first([](const file_content& c) { return c.B; });
  eos.B = told.B     ? positive("B", *told.B)
          : header_B ? positive("B of the header", *header_B)
                     : tait().B * eos.rho0 / tait().rho0;
  s.tell("B", number_text(eos.B),
         told.B     ? origin::given
         : header_B ? origin::read
                    : origin::assumed,
         told.B     ? "by option"
         : header_B ? "the header"
                    : "speed of sound of " + number_text(eos.sound_speed0()) + " m/s");
  const auto gravity = s.first([](const file_content& c) { return c.gravity; });
  s.made.initial.gravity = gravity.value_or(0);
  if (!std::isfinite(s.made.initial.gravity)) throw error(s.named() + ": gravity is " + number_text(*gravity));
  s.tell("gravity", number_text(s.made.initial.gravity), gravity ? origin::read : origin::assumed,
         gravity ? "the header" : "no file says it");
}

void gather(set_in_making& s) {
  particle_table& p = s.made.initial.particles;
  p = particle_table(s.dim());
  const bool as_it_is = s.files.size() == 1 && std::ranges::is_sorted(s.files[0].content.kind);
  const auto column = [&](auto&& of) {
    auto& first = of(s.files[0].content);
    if (as_it_is) return std::move(first);
    std::remove_reference_t<decltype(first)> all;
    std::size_t rows = 0;
    for (const one_file& f : s.files) rows += f.rows;
    all.reserve(rows);
    for (const particle_kind k : {particle_kind::fluid, particle_kind::boundary})
      for (one_file& f : s.files) {
        const auto& from = of(f.content);
        for (std::size_t i = 0; i < f.rows; ++i)
          if (f.content.kind[i] == k) all.push_back(from[i]);
      }
    for (one_file& f : s.files) std::remove_reference_t<decltype(first)>().swap(of(f.content));
    return all;
  };
  for (one_file& f : s.files) {
    std::vector<double>().swap(f.content.h);
    for (std::size_t d = 0; d < 3; ++d)
      if (std::ranges::find(s.axes, d) == s.axes.end())
        for (auto* const left : {&f.content.x[d], &f.content.v[d]}) std::vector<double>().swap(*left);
  }
  for (std::size_t d = 0; d < s.axes.size(); ++d) {
    p.x[d] = column([&](file_content & c) -> auto& { return c.x[s.axes[d]]; });
    p.v[d] = column([&](file_content & c) -> auto& { return c.v[s.axes[d]]; });
  }
  p.rho = column([](file_content & c) -> auto& { return c.rho; });
  p.m = column([](file_content & c) -> auto& { return c.m; });
  p.kind = column([](file_content & c) -> auto& { return c.kind; });
}

}  // namespace pairsum::files
