#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <pairsum/core/error.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/in_child.hpp>
#include <pairsum/files/nearest_spacing.hpp>
#include <pairsum/files/read_particles.hpp>
#include <pairsum/files/words.hpp>
#include <pairsum/files/write_hdf.hpp>

namespace pairsum::files {
namespace {

/// A folder that goes with its test.
class files_test : public testing::Test {
 protected:
  files_test() : folder_(std::filesystem::temp_directory_path() / ("pairsum_files_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~files_test() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

std::string problem_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const error& e) {
    return e.what();
  }
  return "none";
}

file_content in_two_s(const std::function<file_content()>& read) { return in_child("a.file", 2, read); }

TEST(in_child, hands_over_every_member) {
  file_content told;
  told.more.resize(2);
  told.more[1].label = "PartType1";
  told.more[1].rho = {10};
  told.format = "f";
  told.dialect = "d";
  told.x = {{{1, 2}, {3, 4}, {}}};
  told.v[1] = std::vector<double>(300'000, 0.1);  // more than a pipe holds
  told.rho = {5, 6};
  told.m = {7, 8};
  told.h = {9, NAN};
  told.kind = {particle_kind::boundary, particle_kind::fluid};
  told.others = {{"Type", {1, 3}}, {"Mk", {}}};
  told.dim = 2;
  told.H = 0.15;
  told.dx = 0.1;
  told.h_of_all = 0.2;
  told.m_of_all = 0.3;
  told.m_of_boundary = 0.4;
  told.rho0 = 0.5;
  told.B = 0.6;
  told.gravity = 0.65;
  told.support = 0.7;
  told.time = 0.8;
  told.box_low = {1, 2};
  told.box_high = {3, 4};
  told.periodic = axes{{true, false, true}};
  told.periodic_by_habit = true;
  told.kinds_by_name = true;
  told.facts = {{"what", "value", origin::derived, "from"}};
  told.parts = {"a.0", "a.1"};
  told.groups = {"fluid", "wall"};
  const file_content got = in_two_s([&] { return told; });
  EXPECT_EQ(got.format + got.dialect, "fd");
  EXPECT_EQ(got.x, told.x);
  EXPECT_EQ(got.v, told.v);
  EXPECT_EQ(got.rho, told.rho);
  EXPECT_EQ(got.m, told.m);
  EXPECT_TRUE(got.h[0] == 9 && std::isnan(got.h[1]));
  EXPECT_EQ(got.kind, told.kind);
  EXPECT_EQ(got.others, told.others);
  for (const auto member : {&file_content::H, &file_content::dx, &file_content::h_of_all, &file_content::m_of_all,
                            &file_content::m_of_boundary, &file_content::rho0, &file_content::B, &file_content::gravity,
                            &file_content::support, &file_content::time})
    EXPECT_EQ(got.*member, told.*member);
  EXPECT_EQ(got.dim, told.dim);
  EXPECT_EQ(got.box_low, told.box_low);
  EXPECT_EQ(got.box_high, told.box_high);
  EXPECT_EQ(got.periodic, told.periodic);
  EXPECT_TRUE(got.periodic_by_habit);
  EXPECT_TRUE(got.kinds_by_name);
  EXPECT_EQ(got.parts, told.parts);
  EXPECT_EQ(got.groups, told.groups);
  ASSERT_EQ(got.more.size(), 2u);
  EXPECT_EQ(got.more[1].label, "PartType1");
  EXPECT_EQ(got.more[1].rho, std::vector<double>{10});
  ASSERT_EQ(got.facts.size(), 1u);
  EXPECT_EQ(got.facts[0].what + got.facts[0].value + got.facts[0].from, "whatvaluefrom");
  EXPECT_EQ(got.facts[0].how, origin::derived);
}

TEST(in_child, an_error_is_the_same_here) {
  const auto line = problem_of([] { in_two_s([]() -> file_content { throw error("a.file: is wrong"); }); });
  EXPECT_EQ(line, "a.file: is wrong");
}

TEST(in_child, a_death_is_one_line) {
  const auto dies = [](int signal) {
    return problem_of([signal] {
      in_two_s([signal] {
        raise(signal);
        return file_content();
      });
    });
  };
  EXPECT_EQ(dies(SIGSEGV),
            "cannot read a.file: its reader died of signal 11 (Segmentation fault); the file is damaged, or the "
            "reader's library is");
  EXPECT_NE(dies(SIGABRT).find("died of signal 6"), std::string::npos);
  EXPECT_NE(dies(SIGKILL).find("died of signal 9"), std::string::npos);
  const auto leaves = problem_of([] { in_two_s([]() -> file_content { _exit(3); }); });
  EXPECT_NE(leaves.find("ended with exit code 3"), std::string::npos);
}

TEST(in_child, a_hang_ends) {
  const auto line = problem_of([] {
    in_two_s([] {
      while (true) pause();
      return file_content();
    });
  });
  EXPECT_EQ(line, "cannot read a.file: its reader did not come to an end within 2 s; is it damaged?");
}

TEST(in_child, a_death_in_the_middle_of_a_column_is_one_line) {
  file_content large;
  large.x[0].assign(10'000'000, 1);
  const auto line = problem_of([&] {
    in_child("a.file", 1, [&] {
      static file_content left = std::move(large);
      alarm(0);
      if (fork() == 0) {  // kills its parent while that writes
        usleep(3000);
        kill(getppid(), SIGKILL);
        _exit(0);
      }
      return left;
    });
  });
  EXPECT_NE(line.find("died of signal 9"), std::string::npos) << line;
}

TEST(words, are_split_and_read) {
  EXPECT_EQ(split("a|b||c", '|'), (std::vector<std::string_view>{"a", "b", "", "c"}));
  EXPECT_TRUE(split("", '|').empty());
  EXPECT_EQ(number_in(" 1.5e3 "), 1500);
  for (const char* const wrong : {"", " ", "1.5x", "1 2", "x"}) EXPECT_FALSE(number_in(wrong)) << wrong;
  EXPECT_FALSE(boundary_rule::of(""));
  EXPECT_TRUE(boundary_rule::of("none")->none());
  EXPECT_EQ(boundary_rule::of("Type=0,1")->values, (std::vector<std::string>{"0", "1"}));
  for (const char* const wrong : {"Type", "Type=", "=1"})
    EXPECT_NE(problem_of([&] { boundary_rule::of(wrong); }), "none") << wrong;
}

TEST(nearest_spacing, of_a_lattice_is_its_spacing) {
  std::vector<double> x, y;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 40; ++k) {
      x.push_back(0.25 * i);
      y.push_back(0.5 * k);
    }
  EXPECT_EQ(nearest_spacing(std::array<const std::vector<double>*, 2>{&x, &y}), 0.25);
  EXPECT_EQ(nearest_spacing(std::array<const std::vector<double>*, 1>{&y}), 0.5) << "points in one place do not count";
  const std::vector<double> one{1}, same(5, 1.0);
  EXPECT_EQ(nearest_spacing(std::array<const std::vector<double>*, 1>{&one}), 0);
  EXPECT_EQ(nearest_spacing(std::array<const std::vector<double>*, 1>{&same}), 0);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST_F(files_test, what_is_written_is_read_bit_for_bit) {
  for (const char* const name : {"dam_break", "periodic_lattice", "random_clustered"})
    for (const int dim : {1, 2, 3}) {
      const double dx = dim == 3 ? 0.06 : dim == 2 ? 0.03 : 0.01;
      initial_condition c;
      try {
        c = make_case(name, {dim, dx, 0, "perturbed", 3});
      } catch (const error&) {
        continue;  // a case that does not exist in 1D
      }
      c.eos.rho0 = 998.2;
      c.eos.B = 1.0 / 3;
      c.gravity = 1.62;
      SCOPED_TRACE(name + std::to_string(dim));
      write_hdf(path("a.hdf"), c,
                {.time = 0.5, .step = 12, .dx = dx, .facts = {{"what", "value", origin::given, "from"}}});
      const read_set got = read_particles({path("a.hdf")});
      const particle_table &a = c.particles, &b = got.initial.particles;
      ASSERT_EQ(b.dim, dim);
      for (std::size_t d = 0; d < a.x.size(); ++d)
        EXPECT_TRUE(same_bits(a.x[d], b.x[d]) && same_bits(a.v[d], b.v[d])) << d;
      EXPECT_TRUE(same_bits(a.rho, b.rho) && same_bits(a.m, b.m));
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(got.initial.omega_low, c.omega_low);
      EXPECT_EQ(got.initial.omega_high, c.omega_high);
      EXPECT_EQ(got.initial.periodic, c.periodic);
      EXPECT_EQ(got.initial.H, c.H);
      EXPECT_EQ(got.initial.eos.rho0, c.eos.rho0);
      EXPECT_EQ(got.initial.eos.B, c.eos.B);
      EXPECT_EQ(got.initial.gravity, c.gravity);
      EXPECT_EQ(got.dx, dx);
      EXPECT_EQ(got.time, 0.5);
      EXPECT_EQ(got.wrapped, 0u);
      EXPECT_EQ(got.hash, hash_of(c));
    }
}

TEST_F(files_test, lost_particles_are_left_out) {
  initial_condition c = make_case("lattice", {3, 0.1, 0, "rest", 1});
  c.particles.kind[5] = particle_kind::lost;
  write_hdf(path("a.hdf"), c);
  const read_set got = read_particles({path("a.hdf")});
  EXPECT_EQ(got.initial.particles.size(), c.particles.size() - 1);
  EXPECT_EQ(got.initial.particles.x[2][5], c.particles.x[2][6]);
}

TEST_F(files_test, the_hash_tells_sets_apart) {
  const initial_condition c = make_case("lattice", {3, 0.1, 0, "rest", 1});
  const std::string hash = hash_of(c);
  EXPECT_EQ(hash.size(), 16u);
  const auto other = [&](const std::function<void(initial_condition&)>& change) {
    initial_condition changed = c;
    change(changed);
    EXPECT_NE(hash_of(changed), hash);
  };
  other([](auto& a) { a.particles.x[1][7] = std::nextafter(a.particles.x[1][7], 1); });
  other([](auto& a) { std::swap(a.particles.x, a.particles.v); });
  other([](auto& a) { a.particles.kind.back() = particle_kind::boundary; });
  other([](auto& a) { a.H *= 2; });
  other([](auto& a) { a.omega_high[0] += 1; });
  other([](auto& a) { a.eos.B += 1; });
  other([](auto& a) { a.periodic = decltype(a.periodic){true}; });
}

TEST_F(files_test, a_file_that_cannot_be_written_leaves_nothing) {
  const initial_condition c = make_case("lattice", {3, 0.1, 0, "rest", 1});
  const std::string line = problem_of([&] { write_hdf(path("none/a.hdf"), c); });
  EXPECT_TRUE(line.starts_with("cannot write " + path("none/a.hdf"))) << line;
  std::filesystem::create_directory(path("a.hdf"));
  EXPECT_NE(problem_of([&] { write_hdf(path("a.hdf"), c); }), "none");
  EXPECT_NE(problem_of([&] { write_xmf(path("none/a.xmf"), {}); }), "none");
  for (const auto& entry : std::filesystem::directory_iterator(path(""))) EXPECT_EQ(entry.path().filename(), "a.hdf");
}

TEST_F(files_test, what_is_no_file_of_particles_is_one_line) {
  std::ofstream(path("empty")).close();
  std::ofstream(path("text.vtu")) << "<VTKFile/>";
  EXPECT_EQ(problem_of([&] { read_file(path("none")); }),
            "cannot read " + path("none") + ": No such file or directory");
  EXPECT_NE(problem_of([&] { read_file(path("")); }).find("folder"), std::string::npos);
  EXPECT_NE(problem_of([&] { read_file(path("empty")); }).find("empty"), std::string::npos);
  EXPECT_NE(problem_of([&] { read_file("/dev/zero"); }).find("no regular file"), std::string::npos);
  EXPECT_NE(problem_of([&] { read_file(path("text.vtu")); }).find("`pairsum convert"), std::string::npos);
  EXPECT_EQ(problem_of([&] { read_particles({}); }), "no file of particles is named");
}

TEST(formats, have_names_of_their_own) {
  std::vector<std::string_view> names;
  for (const file_format& f : file_formats()) {
    EXPECT_FALSE(f.description.empty());
    names.push_back(f.name);
  }
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
  EXPECT_NE(std::ranges::find(names, "hdf5"), names.end());
}

}  // namespace
}  // namespace pairsum::files
