// The box that particles of files lie in.
#include <algorithm>
#include <cmath>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/vec.hpp>
#include <pairsum/files/set_in_making.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

/// Values of the kept axes, of a list with one for each axis of the files or of the set; none for other lists.
std::optional<std::vector<double>> of_axes(const set_in_making& s, const std::vector<double>& all) {
  if (all.size() == s.axes.size()) return all;
  std::vector<double> kept;
  for (const std::size_t d : s.axes)
    if (d < all.size()) kept.push_back(all[d]);
  if (kept.size() < s.axes.size()) return {};
  return kept;
}

std::string box_text(const std::vector<double>& low, const std::vector<double>& high) {
  std::string text;
  for (std::size_t d = 0; d < low.size(); ++d)
    text += (d > 0 ? " x " : "") + ("[" + number_text(low[d]) + ", " + number_text(high[d]) + "]");
  return text;
}

/// An axis of the set, as the files call it.
std::string named(const set_in_making& s, std::size_t d) { return std::string(1, "xyz"[s.axes[d]]); }

/// Axes of the set, as the files call them.
axes of_files(const set_in_making& s, const axes& of_set) {
  axes on;
  for (std::size_t d = 0; d < s.axes.size(); ++d) on.on[s.axes[d]] = of_set.on[d];
  return on;
}

/// "x,z", "all" or "none", of the files' axes, as axes of the set.
axes periodic_of(const set_in_making& s, const std::string& text) {
  if (text == "all") return axes::all(s.dim());
  axes on;
  if (text == "none") return on;
  for (const std::string_view word : split(text, ',')) {
    const std::size_t axis = word.size() == 1 ? std::string_view("xyz").find(word[0]) : std::string_view::npos;
    const auto at = std::ranges::find(s.axes, axis);
    if (axis == std::string_view::npos || at == s.axes.end())
      throw error("--periodic is \"" + text +
                  "\", should be none, all, or some of the axes along which particles lie, as in x,y");
    on.on[static_cast<std::size_t>(at - s.axes.begin())] = true;
  }
  return on;
}

/// Moved by whole edges into [low, high), as the library does it.
double wrapped(double x, double low, double high) {
  box<1, double> line;
  line.low[0] = low;
  line.high[0] = high;
  return line.wrapped(0, x);
}

/// What the box is, before periodic axes: given, read, or empty.
void read_box(set_in_making& s, std::vector<double>& low, std::vector<double>& high) {
  const std::vector<double>& told = s.told.box;
  if (!told.empty()) {
    const std::size_t dim = s.axes.size(), half = told.size() / 2;
    const bool corners = told.size() == 2 * dim || (told.size() == 6 && dim < 3);
    const auto begin = told.begin(), middle = begin + static_cast<std::ptrdiff_t>(half);
    const auto a = corners ? of_axes(s, {begin, middle}) : std::vector<double>(dim, 0.0);
    const auto b = corners ? of_axes(s, {middle, told.end()}) : of_axes(s, told);
    if ((!corners && told.size() != dim && told.size() != 3) || !a || !b)
      throw error("--box has " + std::to_string(told.size()) + " numbers, should have " + std::to_string(dim) +
                  " edges of a box at 0, or " + std::to_string(2 * dim) + ": its low and its high corner");
    low = *a;
    high = *b;
    s.tell("box", box_text(low, high), origin::given, "--box");
    return;
  }
  const one_file* first = nullptr;
  for (const one_file& f : s.files) {
    if (f.content.box_low.empty()) continue;
    const auto a = of_axes(s, f.content.box_low), b = of_axes(s, f.content.box_high);
    if (!a || !b) throw error(f.path + ": the box has fewer axes than particles; --box says it");
    if (!std::ranges::equal(*a, *b, std::ranges::not_equal_to())) continue;  // a box without edges is none
    if (!first) {
      first = &f;
      low = *a;
      high = *b;
      s.tell("box", box_text(low, high), origin::read, "the header of " + f.path);
    } else if (low != *a || high != *b) {
      throw error(f.path + " has the box " + box_text(*a, *b) + ", but " + first->path + " has " + box_text(low, high) +
                  "; files of a set should have one, and --box says which");
    }
  }
}

/// Along which axes files that have a box say that it is periodic.
std::optional<axes> read_periodic(const set_in_making& s) {
  const one_file* first = nullptr;
  for (const one_file& f : s.files) {
    if (f.content.box_low.empty() || !f.content.periodic) continue;
    if (first && *first->content.periodic != *f.content.periodic)
      throw error(f.path + " is periodic along " + f.content.periodic->text() + ", but " + first->path + " along " +
                  first->content.periodic->text() + "; --periodic says what the set is");
    if (!first) first = &f;
  }
  return first ? first->content.periodic : std::nullopt;
}

}  // namespace

void choose_domain(set_in_making& s) {
  initial_condition& made = s.made.initial;
  particle_table& p = made.particles;
  std::vector<double>&low = made.omega_low, &high = made.omega_high;
  read_box(s, low, high);
  const bool boxed = !low.empty();
  const auto said = s.told.periodic ? std::nullopt : read_periodic(s);
  axes periodic;
  if (s.told.periodic) {
    periodic = periodic_of(s, *s.told.periodic);
  } else if (said && boxed) {
    for (std::size_t d = 0; d < s.axes.size(); ++d) periodic.on[d] = said->on[s.axes[d]];
  }
  if (periodic.any() && !boxed)
    throw error(s.named() + ": periodic axes need a box, and the file has none; --box says it");
  std::string widened;
  for (std::size_t d = 0; d < s.axes.size(); ++d) {
    const auto [least, most] = std::ranges::minmax(p.x[d]);
    if (!boxed) {
      low.push_back(least - made.H);
      high.push_back(most + made.H);
    }
    if (!(low[d] < high[d]) || !std::isfinite(high[d] - low[d]))
      throw error(s.named() + ": the box goes from " + number_text(low[d]) + " to " + number_text(high[d]) + " along " +
                  named(s, d) + ", should go up");
    if (!periodic.on[d] && (least < low[d] || most > high[d])) {
      if (!s.told.box.empty())
        throw error(s.named() + ": particles lie from " + number_text(least) + " to " + number_text(most) + " along " +
                    named(s, d) + ", outside of --box, which goes from " + number_text(low[d]) + " to " +
                    number_text(high[d]));
      low[d] = std::min(low[d], least);
      high[d] = std::max(high[d], most);
      widened += (widened.empty() ? "" : ", ") + named(s, d);
    }
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    bool moved = false;
    for (std::size_t d = 0; d < s.axes.size(); ++d)
      if (double& x = p.x[d][i]; periodic.on[d] && !(x >= low[d] && x < high[d])) {
        x = wrapped(x, low[d], high[d]);
        moved = true;
      }
    s.made.wrapped += moved;
  }
  if (!boxed) s.tell("box", box_text(low, high), origin::derived, "where particles are, and H more at each side");
  if (!widened.empty())
    s.tell("box", box_text(low, high), origin::derived, "widened along " + widened + " to hold all particles");
  const bool by_habit = std::ranges::any_of(s.files, [](const one_file& f) { return f.content.periodic_by_habit; });
  if (s.told.periodic)
    s.tell("periodic", of_files(s, periodic).text(), origin::given, "--periodic");
  else if (said && boxed && !by_habit)
    s.tell("periodic", of_files(s, periodic).text(), origin::read, "the file");
  else
    s.tell("periodic", of_files(s, periodic).text(), origin::assumed, "no file says it; --periodic does");
  if (s.made.wrapped > 0)
    s.tell("wrapped", std::to_string(s.made.wrapped), origin::derived,
           "particles outside of the periodic box, moved into it");
  made.periodic = periodic;
}

}  // namespace pairsum::files
