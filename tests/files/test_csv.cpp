#include "made_file.hpp"

namespace pairsum::files {
namespace {

struct csv_text {
  const char *name, *text;
};
void PrintTo(const csv_text& t, std::ostream* out) { *out << t.name; }

// All hold the same two particles.
class csv_reads : public testing::TestWithParam<csv_text> {};

TEST_P(csv_reads, two_particles) {
  const file_content c = read_bytes("two.csv", GetParam().text);
  EXPECT_EQ(c.format, "csv");
  EXPECT_EQ(c.x[0], (numbers{0.5, -1.25}));
  EXPECT_EQ(c.x[1], (numbers{1, 2e-3}));
  EXPECT_EQ(c.x[2], (numbers{3, 4}));
  EXPECT_FALSE(c.dim.has_value());
}

INSTANTIATE_TEST_SUITE_P(
    csv, csv_reads,
    testing::Values(csv_text{"plain", "x,y,z\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"no_end_of_line", "x,y,z\n0.5,1,3\n-1.25,2e-3,4"},
                    csv_text{"crlf", "x,y,z\r\n0.5,1,3\r\n-1.25,2e-3,4\r\n"},
                    csv_text{"byte_order_mark", "\xef\xbb\xbfx,y,z\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"mark_and_quotes", "\xef\xbb\xbf\"x\",\"y\",\"z\"\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"semicolons", "x;y;z\n0.5;1;3\n-1.25;2e-3;4\n"},
                    csv_text{"tabs", "x\ty\tz\n0.5\t1\t3\n-1.25\t2e-3\t4\n"},
                    csv_text{"decimal_commas", "x;y;z\n0,5;1;3\n-1,25;2e-3;4\n"},
                    csv_text{"quoted_decimal_commas", "x,y,z\n\"0,5\",1,3\n\"-1,25\",2e-3,4\n"},
                    csv_text{"order", "z,x,y\n3,0.5,1\n4,-1.25,2e-3\n"},
                    csv_text{"case", "X,Y,Z\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"quoted_numbers", "\"z\",\"x\",\"y\"\n\"3\",\"0.5\",\"1\"\n\"4\",\"-1.25\",\"2e-3\"\n"},
                    csv_text{"paraview", "\"Mk\",\"Points:0\",\"Points:1\",\"Points:2\"\n7,0.5,1,3\n7,-1.25,2e-3,4\n"},
                    csv_text{"newer_paraview", "Points_0,Points_1,Points_2\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"units", "Pos.x [m];Pos.y [m];Pos.z [m]\n0.5;1;3\n-1.25;2e-3;4\n"},
                    csv_text{"units_in_parentheses", "x (m),y (m),z (m)\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"axes_in_parentheses", "Position (x),Position (y),Position (z)\n0.5,1,3\n-1.25,2e-3,4\n"},
                    csv_text{"trailing_columns", "x,y,z,\n0.5,1,3,\n-1.25,2e-3,4,\n"},
                    csv_text{"trailing_separators", "x,y,z\n0.5,1,3,,\n-1.25,2e-3,4\n"},
                    csv_text{"index_without_name", ",x,y,z\n0,0.5,1,3\n1,-1.25,2e-3,4\n"},
                    csv_text{"words_elsewhere", "x,name,y,z\n0.5,\"a, \"\"b\"\"\",1,3\n-1.25,,2e-3,4\n"},
                    csv_text{"blanks_and_signs", " x , y , z \n +0.5 , 1,\t3\n-1.25,2e-3 ,4\n"},
                    csv_text{"comments", "# made by hand\n\n# x,y,z\n0.5,1,3\n# half\n-1.25,2e-3,4\n\n"},
                    csv_text{"too_small_for_a_double", "x,y,z,rho\n0.5,1,3,1e-400\n-1.25,2e-3,4,1e-320\n"}),
    [](const auto& one) { return std::string(one.param.name); });

// As PartVTK of DualSPHysics writes: a preamble of names and numbers, an empty line, an empty last column.
const std::string part_vtk =
    "TimeStep [s],Np,Nbound,Nfixed,Nmoving,Nfloat,Nfluid\n0.25,4,2,1,1,0,2\n\n"
    "Pos.x [m],Pos.y [m],Pos.z [m],Idp,Vel.x [m/s],Vel.y [m/s],Vel.z [m/s],Rhop [kg/m^3],Mass [kg],Type,Mk,\n"
    "1,2,3,0,0,0,0,1000,0.125,0,10,\n4,5,6,1,.1,.2,.3,1001,0.125,1,11,\n"
    "7,8,9,2,1,2,3,1002,0.25,3,1,\n10,11,12,3,4,5,6,1003,0.25,3,1,\n";

TEST(csv, what_part_vtk_writes) {
  const file_content c = read_bytes("part.csv", part_vtk);
  using enum particle_kind;
  EXPECT_EQ(c.dialect, "dualsphysics");
  EXPECT_EQ(c.time, 0.25);
  EXPECT_EQ(c.x[2], (numbers{3, 6, 9, 12}));
  EXPECT_EQ(c.v[1], (numbers{0, .2, 2, 5}));
  EXPECT_EQ(c.rho, (numbers{1000, 1001, 1002, 1003}));
  EXPECT_EQ(c.m, (numbers{.125, .125, .25, .25}));
  EXPECT_EQ(c.kind, (std::vector{boundary, boundary, fluid, fluid}));
  EXPECT_TRUE(c.facts.empty());
}

TEST(csv, the_kind_by_pairsum_s_own_column) {
  using enum particle_kind;
  EXPECT_EQ(read_bytes("kind.csv", "x,y,Type,Kind\n1,2,3,1\n2,2,3,0\n").kind, (std::vector{boundary, fluid}));
  hints told;
  told.boundary_kind = "Type=0";
  EXPECT_TRUE(read_bytes("kind.csv", "x,y,Type,Kind\n1,2,3,1\n", told).kind.empty());
  EXPECT_TRUE(read_bytes("lower.csv", "x,y,kind\n1,2,1\n").kind.empty());
}

TEST(csv, the_kind_by_another_column_or_by_none) {
  hints told;
  told.boundary_kind = "Mk=10,11";
  const file_content c = read_bytes("part.csv", part_vtk, told);
  EXPECT_EQ(c.others.at("Mk"), (numbers{10, 11, 1, 1}));
  EXPECT_TRUE(c.kind.empty());
  told.boundary_kind = "none";
  EXPECT_TRUE(read_bytes("part.csv", part_vtk, told).kind.empty());
  EXPECT_EQ(read_bytes("floating.csv", "x,y,Type\n1,2,2\n", told).x[0], numbers{1});
  told.boundary_kind = "Zone=0";
  EXPECT_EQ(refusal("part.csv", "x,y,Mk\n1,2,3\n", told),
            ": line 1: there is no column \"Zone\" (--boundary-kind), but \"x\", \"y\", \"Mk\"");
}

TEST(csv, two_axes_are_2d) {
  const file_content flat = read_bytes("xz.csv", "x,z,vx,vy,vz\n1,2,3,4,5\n");
  EXPECT_EQ(flat.dim, 2);
  EXPECT_EQ(flat.x[0], numbers{1});
  EXPECT_EQ(flat.x[2], numbers{2});
  EXPECT_TRUE(flat.x[1].empty());
  EXPECT_EQ(flat.v[0], numbers{3});
  EXPECT_EQ(flat.v[2], numbers{5});
  EXPECT_TRUE(flat.v[1].empty());
  EXPECT_EQ(read_bytes("xy.csv", "x,y,u,v,w\n1,2,3,4,5\n").v[1], numbers{4});
  EXPECT_EQ(read_bytes("xyz.csv", "x,y,z,w,v,u\n1,2,3,4,5,6\n").v,
            (std::array<std::vector<double>, 3>{numbers{6}, numbers{5}, numbers{4}}));
}

TEST(csv, columns_by_option_come_before_known_words) {
  hints told;
  told.columns = {{"x", "Points:0"}, {"y", "b \"2\""}, {"rho", "dens [kg/m^3]"}};
  const file_content c = read_bytes("told.csv", "x,Points:0,\"b \"\"2\"\"\",Dens\n9,1,2,1000\n", told);
  EXPECT_EQ(c.x[0], numbers{1});
  EXPECT_EQ(c.x[1], numbers{2});
  EXPECT_EQ(c.rho, numbers{1000});
  told.columns = {{"vx", "u1"}};
  EXPECT_EQ(refusal("told.csv", "x,y,u2\n1,2,3\n", told),
            ": line 1: there is no column \"u1\" (--column vx), but \"x\", \"y\", \"u2\"");
  told.columns = {{"x", "Points:0"}};
  EXPECT_EQ(refusal("told.csv", "x,y\n1,2\n", told),
            " has no column \"Points:0\" (--column x=...); line 1 has \"x\", \"y\"");
  told.columns = {{"r", "x"}};
  EXPECT_EQ(refusal("told.csv", "x,y\n1,2\n", told),
            "unknown quantity of --column \"r\"; valid: x, y, z, vx, vy, vz, rho, m, h, kind");
}

TEST(csv, the_time_of_a_comment) {
  EXPECT_EQ(read_bytes("t.csv", "# time = 0.5\nx,y\n1,2\n").time, 0.5);
  EXPECT_EQ(read_bytes("t.csv", "Time,0.25,\nx,y\n1,2\n").time, 0.25);
  EXPECT_EQ(read_bytes("t.csv", "Time [s];0,75\nx;y\n1;2\n").time, 0.75);
  EXPECT_FALSE(read_bytes("t.csv", "# time = late\nx,y\n1,2\n").time.has_value());
  EXPECT_FALSE(read_bytes("t.csv", "x,y\n1,2\n").time.has_value());
}

TEST(csv, units_that_are_not_pairsums_are_told) {
  const file_content c = read_bytes("mm.csv", "x [mm],y [m],rho [g/cm^3]\n1,2,1\n");
  ASSERT_EQ(c.facts.size(), 2u);
  EXPECT_EQ(c.facts[0].what + " " + c.facts[0].value, "unit of x mm");
  EXPECT_EQ(c.facts[1].what + " " + c.facts[1].value, "unit of rho g/cm^3");
}

TEST(csv, an_empty_column_is_as_if_it_were_not_there) {
  const file_content c = read_bytes("e.csv", "x,y,rho,m,vx,vy,Mk\n1,2,,1,,,\n3,4,,1,,,7\n");
  EXPECT_TRUE(c.rho.empty());
  EXPECT_TRUE(c.v[0].empty());
  EXPECT_EQ(c.m, (numbers{1, 1}));
}

TEST(csv, lines_across_pieces_of_the_file_and_no_more_memory_than_columns_need) {
  constexpr std::size_t rows = 120'000;  // of 20 bytes: more than two megabytes
  std::string text = "x,y,rho\n";
  for (std::size_t k = 0; k < rows; ++k) text += std::to_string(k) + ".25," + std::to_string(k) + ",1000.5\r\n";
  const file_content c = read_bytes("long.csv", text);
  ASSERT_EQ(c.x[0].size(), rows);
  for (std::size_t k = 0; k < rows; ++k) {
    ASSERT_EQ(c.x[0][k], static_cast<double>(k) + .25);
    ASSERT_EQ(c.x[1][k], static_cast<double>(k));
  }
  EXPECT_LE(c.x[0].capacity(), rows + 1);
  EXPECT_LE(c.rho.capacity(), rows + 1);
}

TEST(csv, is_found_without_its_ending) {
  EXPECT_EQ(read_bytes("particles.txt", "# by hand\nx y\nPoints:0;Points:1\n1;2\n").format, "csv");
  EXPECT_EQ(refusal("particles.txt", "a,b\n1,2\n"), " is of no format that pairsum reads: hdf5, bi4, csv");
}

struct bad_csv {
  const char *name, *text, *what;
};
void PrintTo(const bad_csv& t, std::ostream* out) { *out << t.name; }
class csv_refuses : public testing::TestWithParam<bad_csv> {};

TEST_P(csv_refuses, with_one_line) { EXPECT_EQ(refusal("bad.csv", GetParam().text), GetParam().what); }

INSTANTIATE_TEST_SUITE_P(
    csv, csv_refuses,
    testing::Values(
        bad_csv{"unknown_columns", "made\nfoo;bar\n1;2\n",
                " has no columns that are known as x and as y or z; line 2 has \"foo\", \"bar\"; say which, for "
                "example --column x=NAME"},
        bad_csv{"one_axis", "x,rho\n1,2\n",
                " has no columns that are known as x and as y or z; line 1 has \"x\", \"rho\"; say which, for example "
                "--column x=NAME"},
        bad_csv{"no_names", "1,2,3\n4,5,6\n",
                " names no columns; a line above the numbers should, for example x,y,z,vx,vy,vz,rho, with commas, "
                "semicolons or tabs"},
        bad_csv{"no_rows", "x,y\n# none\n", ": line 2: no particles: no line of numbers below that of names"},
        bad_csv{"twice", "x,y,x\n1,2,3\n", ": line 1: there are two columns \"x\""},
        bad_csv{"word", "x,y\n1,2\n3,four\n", ": line 3: \"y\" is \"four\", should be a number"},
        bad_csv{"number_and_word", "x,y\n1,2 m\n", ": line 2: \"y\" is \"2 m\", should be a number"},
        bad_csv{"not_a_number", "x,y\n1,2\n\nnan,1\n", ": line 4: \"x\" is \"nan\", should be a number"},
        bad_csv{"infinite", "x,y,rho\n1,2,-inf\n", ": line 2: \"rho\" is \"-inf\", should be a number"},
        bad_csv{"too_large", "x,y\n1,1e999\n", ": line 2: \"y\" is \"1e999\", should be a number"},
        bad_csv{"empty_position", "x,y\n1,\n",
                ": line 2: \"y\" is empty; it should be a number in all lines or in none"},
        bad_csv{"empty_later", "x,y,rho\n1,2,3\n1,2,\n",
                ": line 3: \"rho\" is empty; it should be a number in all lines or in none"},
        bad_csv{"empty_before", "x,y,rho\n1,2,\n1,2,3\n",
                ": line 3: \"rho\" has a number here, and none in lines above"},
        bad_csv{"few_fields", "x,y,z\n1,2,3\n1,2\n", ": line 3: has 2 fields, should have 3 as the line of names"},
        bad_csv{"many_fields", "x,y\n1,2\n1,2,3\n", ": line 3: has 3 fields, should have 2 as the line of names"},
        bad_csv{"two_marks", "x;y\n0.5;1\n0,5;1\n",
                ": line 3: \"x\" is \"0,5\": numbers here have decimal points, others decimal commas"},
        bad_csv{"thousands", "x;y\n1.234,5;1\n", ": line 2: \"x\" is \"1.234,5\", should be a number"},
        bad_csv{"open_quote", "x,y\n1,\"2\n", ": line 2: a quote is not closed, or something follows it"},
        bad_csv{"behind_a_quote", "x,y\n\"1\"2,3\n", ": line 2: a quote is not closed, or something follows it"},
        bad_csv{"floating", "x,y,Type\n1,2,3\n1,2,2\n",
                ": line 3: \"Type\" is 2, a floating body, which pairsum does not sum; --boundary-kind none takes all "
                "particles for fluid"},
        bad_csv{"kind_of_neither", "x,y,Kind\n1,2,2\n",
                ": line 2: \"Kind\" is 2, should be 0 (fluid) or 1 (boundary); for other numbers say --boundary-kind "
                "\"Kind=2\", or none"},
        bad_csv{"another_kind", "x,y,Type\n1,2,4\n",
                ": line 2: \"Type\" is 4, should be 0 or 1 (wall) or 3 (fluid); for other numbers say --boundary-kind "
                "\"NAME=0,1\", or none"},
        bad_csv{"one_velocity", "x,y,z,vx,vz\n1,2,3,4,5\n",
                ": line 1: has 2 of 3 velocities among \"x\", \"y\", \"z\", \"vx\", \"vz\"; --column vx=NAME says "
                "which others"},
        bad_csv{"empty_velocity", "x,y,vx,vy\n1,2,3,\n", " has velocities of which some are empty"},
        bad_csv{"ends_of_lines", "x,y\r1,2\r", ": line 1: lines end in CR alone, should end in LF or CR LF"},
        bad_csv{"utf_16", "\xff\xfex,y\n",
                " is text in UTF-16, should be in UTF-8; save it so, or `iconv -f UTF-16 -t UTF-8` makes it so"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(csv, what_is_no_text) {
  EXPECT_EQ(refusal("zero.csv", std::string("x,y\n1,\0\n", 8)), " is no text: it has a byte 0");
  EXPECT_EQ(refusal("line.csv", "x,y\n" + std::string(3 << 20, '1')),
            ": line 2: is longer than a megabyte; it should have the numbers of one particle");
  std::string wide = "x,y";
  for (int k = 0; k < 1000; ++k) wide += ",c";
  EXPECT_TRUE(refusal("wide.csv", wide + "\n").starts_with(" names no columns"));
  EXPECT_EQ(refusal("name.csv", "a\x1b[0m,b\x01\n1,2\n"),
            " has no columns that are known as x and as y or z; line 1 has \"a?[0m\", \"b?\"; say "
            "which, for example --column x=NAME");
}

}  // namespace
}  // namespace pairsum::files
