#include <cmath>
#include <limits>
#include <map>

#include "bi4_bytes.hpp"
#include "made_file.hpp"

namespace pairsum::files {
namespace {

enum : std::uint32_t {
  text_type = 1,
  boolean = 2,
  integer = 7,
  uint32 = 8,
  uint64 = 10,
  real32 = 11,
  real64 = 12,
  real32x3 = 22,
  real64x3 = 23
};

/// A small file: two walls (one moves), then two of the fluid, in an order of its own.
struct small {
  bi4_bytes w;
  double floating = 0;
  int periodic = 0;
  bool flat = false, in_double = false;
  std::vector<double> x_image{0, 0, 0}, box_low{0, 0, 0}, box_high{2, 3, 4};
  std::vector<float> rho{1000, 1001, 1002, 1003};
  std::vector<std::string> more_arrays;

  std::vector<std::string> values() const {
    return {w.value<std::uint32_t>("Piece", uint32, {0}),
            w.value<std::uint32_t>("Npiece", uint32, {1}),
            w.words("AppName", "DualSPHysics5"),
            w.value<std::int32_t>("Data2d", boolean, {flat}),
            w.value<double>("MapPosMin", real64x3, box_low),
            w.value<double>("MapPosMax", real64x3, box_high),
            w.value<std::int32_t>("PeriMode", integer, {periodic}),
            w.value<double>("PeriXinc", real64x3, x_image),
            w.value<std::uint64_t>("CaseNfixed", uint64, {1}),
            w.value<std::uint64_t>("CaseNmoving", uint64, {1}),
            w.value<std::uint64_t>("CaseNfloat", uint64, {static_cast<std::uint64_t>(floating)}),
            w.value<double>("Dp", real64, {.05}),
            w.value<double>("H", real64, {.1}),
            w.value<double>("B", real64, {5e5}),
            w.value<double>("Rhop0", real64, {1000}),
            w.value<double>("Gamma", real64, {7}),
            w.value<double>("MassBound", real64, {.25}),
            w.value<double>("MassFluid", real64, {.125})};
  }
  std::vector<std::string> arrays() const {
    const std::vector<double> x{1, 2, 3, .5, 1.5, 2.5, 1.25, 0, .25, .125, .25, .375};
    const std::vector<float> single(x.begin(), x.end());
    std::vector<std::string> all{in_double ? w.array<std::uint64_t>("Idpd", uint64, 4, {2, 0, 3, 1})
                                           : w.array<std::uint32_t>("Idp", uint32, 4, {2, 0, 3, 1}),
                                 in_double ? w.array("Posd", real64x3, 4, x) : w.array("Pos", real32x3, 4, single),
                                 w.array<float>("Vel", real32x3, 4, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}),
                                 w.array("Rhop", real32, 4, rho)};
    all.insert(all.end(), more_arrays.begin(), more_arrays.end());
    return all;
  }
  std::string part() const { return w.item("PART_0001", {w.value<double>("TimeStep", real64, {.75})}, arrays()); }
  std::string bytes() const { return w.head() + w.item("JPartDataBi4", values(), {}, {part()}); }
  file_content content(const hints& told = {}) const { return read_bytes("small.bi4", bytes(), told); }
  std::string refused(const hints& told = {}) const { return refusal("small.bi4", bytes(), told); }
};

void check(const file_content& c) {
  using enum particle_kind;
  EXPECT_EQ(c.format, "bi4");
  EXPECT_EQ(c.dialect, "dualsphysics");
  EXPECT_EQ(c.x[0], (numbers{1, .5, 1.25, .125}));
  EXPECT_EQ(c.x[1], (numbers{2, 1.5, 0, .25}));
  EXPECT_EQ(c.x[2], (numbers{3, 2.5, .25, .375}));
  EXPECT_EQ(c.v[0], (numbers{0, 3, 6, 9}));
  EXPECT_EQ(c.v[2], (numbers{2, 5, 8, 11}));
  EXPECT_EQ(c.rho, (numbers{1000, 1001, 1002, 1003}));
  EXPECT_EQ(c.kind, (std::vector{fluid, boundary, fluid, boundary}));
  EXPECT_EQ(c.dim, 3);
  EXPECT_EQ(c.dx, .05);
  EXPECT_EQ(c.h_of_all, .1);
  EXPECT_EQ(c.support, 2);
  EXPECT_EQ(c.B, 5e5);
  EXPECT_EQ(c.rho0, 1000);
  EXPECT_EQ(c.m_of_all, .125);
  EXPECT_EQ(c.m_of_boundary, .25);
  EXPECT_EQ(c.time, .75);
  EXPECT_EQ(c.box_low, (numbers{0, 0, 0}));
  EXPECT_EQ(c.box_high, (numbers{2, 3, 4}));
  EXPECT_EQ(c.periodic, axes{});
}

TEST(bi4, all_that_a_file_says) { check(small{}.content()); }

TEST(bi4, positions_and_ids_of_64_bits) {
  small s;
  s.in_double = true;
  check(s.content());
}

TEST(bi4, the_other_byte_order) {
  small s;
  s.w.order = std::endian::big;
  s.in_double = true;
  check(s.content());
}

TEST(bi4, mass_and_h_of_each_particle) {
  small s;
  s.more_arrays = {s.w.array<float>("Mass", real32, 4, {1, 2, 3, 4}),
                   s.w.array<float>("Hvar", real32, 4, {.5, .25, .5, .25})};
  EXPECT_EQ(s.content().m, (numbers{1, 2, 3, 4}));
  EXPECT_EQ(s.content().h, (numbers{.5, .25, .5, .25}));
}

TEST(bi4, a_file_of_2d_has_the_axes_x_and_z) {
  small s;
  s.flat = true;
  s.periodic = 4;
  const file_content c = s.content();
  EXPECT_EQ(c.dim, 2);
  EXPECT_EQ(c.x[0], (numbers{1, .5, 1.25, .125}));
  EXPECT_EQ(c.x[2], (numbers{3, 2.5, .25, .375}));
  EXPECT_TRUE(c.x[1].empty());
  EXPECT_EQ(c.v[2], (numbers{2, 5, 8, 11}));
  EXPECT_TRUE(c.v[1].empty());
  EXPECT_EQ(c.box_high, (numbers{2, 3, 4}));
  EXPECT_EQ(c.periodic->text(), "z");
}

TEST(bi4, periodic_axes) {
  small s;
  s.periodic = 5;
  s.x_image = {-1.5, 0, 0};
  EXPECT_EQ(s.content().periodic->text(), "x,z");
  EXPECT_EQ(s.content().box_high, (numbers{1.5, 3, 4}));
  s.x_image = {-2, 0, .1};
  EXPECT_EQ(s.refused(), " has images shifted along another axis (PeriXinc); pairsum's boxes are straight");
  s.box_low = {1, 0, 0};
  s.x_image = {1e-30, 0, 0};
  EXPECT_EQ(s.refused(), " has a period of 1e-30 (PeriXinc), which is nothing beside MapPosMin");
}

TEST(bi4, a_case_before_its_run_has_no_box) {
  small s;
  s.periodic = 96;
  s.box_high = {0, 0, 0};
  EXPECT_FALSE(s.content().periodic.has_value());
  EXPECT_TRUE(s.content().box_low.empty());
}

TEST(bi4, floating_bodies_are_refused_unless_all_are_alike) {
  small s;
  s.floating = 1;
  EXPECT_EQ(s.refused(),
            " has 1 particles of floating bodies, which pairsum does not sum; --boundary-kind none takes all particles "
            "for fluid");
  hints told;
  told.boundary_kind = "none";
  EXPECT_TRUE(s.content(told).kind.empty());
}

TEST(bi4, the_kind_by_an_array) {
  small s;
  s.more_arrays = {s.w.array<std::uint32_t>("Mk", uint32, 4, {1, 10, 1, 11})};
  hints told;
  told.boundary_kind = "Mk=10,11";
  EXPECT_EQ(s.content(told).others.at("Mk"), (numbers{1, 10, 1, 11}));
  EXPECT_TRUE(s.content(told).kind.empty());
  told.boundary_kind = "Type=0";
  EXPECT_EQ(s.refused(told),
            " has no array \"Type\" (--boundary-kind), but \"Idp\", \"Mk\", \"Pos\", \"Rhop\", \"Vel\"");
}

TEST(bi4, what_is_no_particle_file) {
  small s;
  EXPECT_EQ(refusal("head.bi4", s.w.head() + s.w.item("JPartDataBi4", s.values(), {})),
            " has no particles: no array Pos or Posd with rows, of those it has: ");
  hints told;
  told.columns["x"] = "Pos";
  EXPECT_EQ(s.refused(told), " names its columns itself; --column is for CSV");
  s.rho = {1, 2, std::numeric_limits<float>::quiet_NaN(), 4};
  EXPECT_EQ(s.refused(), " has a number that is not finite: row 2 of its array \"Rhop\"");
  s.rho = {1, 2, 3, 4};
  s.more_arrays = {s.w.array<float>("Mass", real32, 3, {1, 2, 3})};
  EXPECT_EQ(s.refused(), " has 3 rows in its array \"Mass\", should have 4 as Pos");
  s.more_arrays = {s.w.array<float>("Mass", real32x3, 4, std::vector<float>(12))};
  EXPECT_EQ(s.refused(), " has 3 numbers a row in its array \"Mass\", should have 1");
  s.more_arrays = {s.w.array<char>("Mass", text_type, 4, {1, 2})};
  EXPECT_EQ(s.refused(), " has no numbers in its array \"Mass\"");
}

// Wherever a file ends, it says so, and takes no memory for what is not there.
TEST(bi4, cut_anywhere) {
  const std::string whole = small{}.bytes();
  for (std::size_t size = 5; size < whole.size(); ++size) {
    const std::string what = refusal("cut.bi4", whole.substr(0, size));
    ASSERT_TRUE(what.starts_with(" is cut short") || what.starts_with(" is damaged")) << size << ": " << what;
  }
}

TEST(bi4, damaged_lengths_and_counts) {
  const bi4_bytes w;
  const auto says = [&](const std::string& rest) { return refusal("damaged.bi4", w.head() + rest); };
  EXPECT_EQ(says(w.count(0xffffffff) + "\nITEM"), " is damaged: a head of 4294967295 bytes at byte 64");
  EXPECT_EQ(says(w.block(w.count(0xffffffff) + "\nITEM")),
            " is damaged: a text or a value is longer than what holds it");
  EXPECT_EQ(says(w.block(w.text("ITEM"))), " is damaged: no item begins at byte 64");
  const std::string item = w.text("\nITEM\n") + w.text("a") + w.count(0) + w.count(0) + w.text("") + w.text("");
  EXPECT_EQ(says(w.block(item + w.count(0) + w.count(0) + w.count(0xffffffff))),
            " is damaged: an item has 4294967295 bytes of values");
  EXPECT_EQ(says(w.block(item + w.count(0xffffffff) + w.count(0xffffffff) + w.count(0))),
            " is cut short: it has 111 bytes, should have at least 115");
  EXPECT_EQ(says(w.item("a", {w.value<double>("b", 99, {1})}, {})),
            " has \"b\" of type 99, which no version is known to write");
  const std::string array = w.text("\nARRAY") + w.text("Pos") + w.count(0) + w.count(real32x3);
  EXPECT_EQ(says(w.item("a", {}, {w.block(array + w.count(0xffffffff) + w.count(0xfffffff0))})),
            " is cut short or damaged: \"Pos\" has 4294967295 rows in 4294967280 bytes, and the file 0 after its head");
  EXPECT_EQ(says(w.item("a", {}, {w.block(array + w.count(0xffffffff) + w.count(4)) + "1234"})),
            " is cut short or damaged: \"Pos\" has 4294967295 rows in 4 bytes, and the file 4 after its head");
  std::string deep = w.item("a", {}, {});
  for (int k = 0; k < 8; ++k) deep = w.item("a", {}, {}, {deep});
  EXPECT_EQ(says(deep), " is damaged: its items nest deeper than 8 levels");
  EXPECT_EQ(says(w.item("a", {}, {}, std::vector(10'001, w.item("a", {}, {})))),
            " is damaged: it has more than 10000 items and arrays");
  std::string order = small{}.bytes();
  order[60] = 2;
  EXPECT_EQ(refusal("order.bi4", order), " is no binary file of DualSPHysics");
  order[60] = 1;
  EXPECT_EQ(refusal("order.bi4", order), " is damaged: a head of 1056964608 bytes at byte 64");
}

/// Pairs with r < H in an open box, each once.
std::size_t pairs(const file_content& c, double H) {
  using cell = std::array<int, 3>;
  std::map<cell, std::vector<std::size_t>> cells;
  std::size_t found = 0;
  for (std::size_t i = 0; i < c.x[0].size(); ++i) {
    cell own;
    for (std::size_t d = 0; d < 3; ++d) own[d] = static_cast<int>(std::floor(c.x[d][i] / H));
    for (int k = 0; k < 27; ++k) {
      const auto near = cells.find({own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1});
      if (near == cells.end()) continue;
      for (const std::size_t j : near->second) {
        double r2 = 0;
        for (std::size_t d = 0; d < 3; ++d) r2 += (c.x[d][i] - c.x[d][j]) * (c.x[d][i] - c.x[d][j]);
        found += r2 < H * H;
      }
    }
    cells[own].push_back(i);
  }
  return found;
}

TEST(bi4, a_file_of_dualsphysics) {
  const std::string path = PAIRSUM_SHARED "/Part_0001.bi4";
  if (!std::ifstream(path)) GTEST_SKIP() << "no " << path;
  const file_content c = read_file(path);
  EXPECT_EQ(c.x[0].size(), 15'844u);
  EXPECT_EQ(std::ranges::count(c.kind, particle_kind::boundary), 10'144);
  EXPECT_EQ(std::ranges::count(c.kind, particle_kind::fluid), 5'700);
  EXPECT_EQ(c.rho.size(), 15'844u);
  EXPECT_EQ(c.v[2].size(), 15'844u);
  EXPECT_EQ(c.dim, 3);
  EXPECT_EQ(c.dx, .05);
  EXPECT_NEAR(*c.h_of_all, .10392305, 1e-8);
  EXPECT_EQ(c.B, 504514.28125);
  EXPECT_EQ(c.rho0, 1000);
  EXPECT_EQ(c.m_of_all, .125);
  EXPECT_EQ(c.m_of_boundary, .125);
  EXPECT_NEAR(*c.time, .1000408, 1e-7);
  EXPECT_EQ(c.periodic->text(), "none");
  EXPECT_EQ(pairs(c, *c.support * *c.h_of_all), 1'951'339u);
}

}  // namespace
}  // namespace pairsum::files
