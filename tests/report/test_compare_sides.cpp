#include "harness/report/compare_sides.hpp"

#include "tests/report/made_builds.hpp"

// Two backends, files or revisions against each other.
namespace pairsum::harness {
namespace {

using synthetic::build;
using synthetic::by;

class compared : public report {
 protected:
  std::string compare(const std::string& a, const std::string& b, bool allow_mixed = false) const {
    compare_request r;
    r.a = a;
    r.b = b;
    r.inputs = {file("talk")};
    r.allow_mixed = allow_mixed;
    return compare_sides(r);
  }

  /// One file of a build's own rounds.
  std::string put_build(const std::string& name, const environment_row& e, double sum_s,
                        const std::string& backend = "naive") const {
    synthetic::write_builds(file(name), {e}, {by(e, {backend, 6, 1, sum_s})});
    return file(name).string();
  }
};

TEST_F(compared, backends_are_paired_by_round) {
  write(talk());
  const std::string text = compare("naive", "symmetric");
  EXPECT_CONTAINS(text, "A: naive\nB: symmetric\n");
  EXPECT_CONTAINS(text, "dam_break rest dx=0.00594 M=6 threads=1");
  EXPECT_CONTAINS(text, "6/6  1050.0  525.00  2.000  [2.000, 2.000]  faster\n");
  EXPECT_CONTAINS(text, "Of 1 comparison B is faster in 1, slower in 0, no difference is resolved in 0 (95 %");
  EXPECT_EQ(text.find("measured apart"), std::string::npos);
  EXPECT_CONTAINS(compare("symmetric", "naive"), "slower in 1");
}

TEST_F(compared, backends_may_differ_in_levels_that_are_named) {
  const auto mixed = [](sample& s) {
    s.point.precision = "mixed";
    s.point.grid = "compact_grid";
    s.point.M = 0;
  };
  write({{"naive", 6, 1, 1.0}, {"naive", 7, 1, 1.2}, {"naive", 7, 1, 0.25, 6, mixed}});
  const std::string text = compare("naive precision=double", "naive precision=mixed grid=compact_grid");
  EXPECT_CONTAINS(text, "dam_break rest dx=0.00594 M=6/compact_grid threads=1");
  EXPECT_CONTAINS(text, "6/6  1050.0  262.50  4.000  [4.000, 4.000]  faster\n");
  EXPECT_CONTAINS(text, "Of 2 comparisons B is faster in 2");
  EXPECT_CONTAINS(compare("naive M=7 precision=double", "naive M=none precision=mixed grid=compact_grid"),
                  "Of 1 comparison B is faster in 1");
  EXPECT_CONTAINS(message_of([&] { compare("naive", "naive precision=mixed"); }), "no point in common");
  EXPECT_CONTAINS(message_of([&] { compare("naive", "naive precison=mixed"); }),
                  "unknown level \"precison\"; valid: state, order, precision");
  EXPECT_CONTAINS(message_of([&] { compare("naive", "naive mixed"); }), "\"mixed\" behind naive is no level");
}

TEST_F(compared, blocks_of_one_side_alone_tell_the_pairs_apart) {
  const auto in = [](const char* block) {
    return [=](sample& s) {
      s.point.block = block;
      if (s.work) s.work->vector_units = {block, 8, 1000, 0.8};
    };
  };
  write(
      {{"naive_omp", 7, 2, 1.0}, {"tiles_omp", 7, 2, 0.5, 6, in("auto")}, {"tiles_omp", 7, 2, 0.25, 6, in("slab:4")}});
  const std::string text = compare("naive_omp", "tiles_omp");
  EXPECT_CONTAINS(text, "M=7 threads=2 native slab:4     6/6  1050.0  262.50  4.000");
  EXPECT_CONTAINS(text, "M=7 threads=2 native            6/6  1050.0  525.00  2.000");
  EXPECT_CONTAINS(compare("tiles_omp", "naive_omp"), "M=7 threads=2 native slab:4     6/6  262.50  1050.0  0.250");
  EXPECT_CONTAINS(compare("tiles_omp block=auto", "tiles_omp block=slab:4"),
                  "M=7 threads=2 native / native slab:4     6/6  525.00  262.50  2.000");
}

/// Rows named the isa of the build; they name what summed now.
TEST_F(compared, scalar_sums_meet_scalar_ones_and_vectors_vectors) {
  const auto on = [](const char* isa) {
    return [=](sample& s) {
      s.point.isa = isa;
      if (s.work && isa == std::string("avx512")) s.work->vector_units = {"none", 8, 1000, 0.8};
    };
  };
  write({{"naive_omp", 7, 2, 1.0, 6, on("native")},
         {"naive_omp", 7, 2, 0.5, 6, on("avx512")},
         {"symmetric_omp", 7, 2, 0.8, 6, on("scalar")},
         {"symmetric_omp", 7, 2, 0.25, 6, on("avx512")},
         {"tiles_omp", 7, 2, 0.2, 6, on("avx512")}});
  const std::string text = compare("naive_omp", "symmetric_omp");
  EXPECT_CONTAINS(text, "Of 2 comparisons B is faster in 2");
  EXPECT_CONTAINS(text, "6/6  1050.0  840.00  1.250");
  EXPECT_CONTAINS(text, "525.00  262.50  2.000");
  EXPECT_CONTAINS(compare("symmetric_omp", "tiles_omp"), "Of 2 comparisons B is faster in 2");
}

TEST_F(compared, another_phase_can_be_asked_for) {
  write(talk());
  compare_request r{"naive", "symmetric", {file("talk")}};
  r.phase = &phases::total_s;
  EXPECT_CONTAINS(compare_sides(r), "2100.0  1050.0  2.000");
}

TEST_F(compared, backends_with_several_granularities_compare_the_fastest) {
  const auto slow = [](sample& s) { s.point.granularity = "dynamic:1"; };
  write({{"naive_omp", 6, 2, 1.0}, {"symmetric_omp", 6, 2, 0.5}, {"symmetric_omp", 6, 2, 0.9, 6, slow}});
  EXPECT_CONTAINS(compare("naive_omp", "symmetric_omp"), "Of 1 comparison B is faster in 1");
}

TEST_F(compared, unverified_points_are_named) {
  auto points = talk();
  points.push_back({"symmetric", 8, 1, 1.0, 6, [](sample& s) { s.verify.fingerprint.reset(); }});
  write(points);
  EXPECT_CONTAINS(compare("naive", "symmetric"), "left out, not verified: symmetric M=8 threads=1: not verified\n");
}

TEST_F(compared, files_are_unpaired) {
  const std::string a = put_build("a.jsonl", build('1', "GNU 12.2.0"), 1.0);
  const std::string b = put_build("b.jsonl", build('2', "Clang 14.0.6"), 0.5);
  const std::string text = compare(a, b);
  EXPECT_CONTAINS(text, "measured apart, so not paired");
  EXPECT_CONTAINS(text, "they differ in compiler (Clang 14.0.6, GNU 12.2.0)");
  EXPECT_CONTAINS(text, "naive dam_break rest dx=0.00594 M=6 threads=1");
  EXPECT_CONTAINS(text, "  2.000  [1.5") << "the disturbance does not cancel";
  EXPECT_CONTAINS(text, "faster in 1");
}

TEST_F(compared, revisions_measured_apart_are_unpaired) {
  put_build("talk/a.jsonl", build('1', "GNU 12.2.0", "1a2b3c4d"), 1.0);
  put_build("talk/b.jsonl", build('2', "GNU 12.2.0", "5e6f7a8b"), 1.0);
  const std::string text = compare("1a2b", "5e6f7a8b99");
  EXPECT_CONTAINS(text, "measured apart, so not paired");
  EXPECT_CONTAINS(text, "they differ in git (1a2b3c4d, 5e6f7a8b)");
  EXPECT_CONTAINS(text, "no difference is resolved in 1");
}

TEST_F(compared, revisions_measured_in_the_same_rounds_are_paired) {
  const environment_row a = build('1', "GNU 12.2.0", "1a2b3c4d"), b = build('2', "GNU 12.2.0", "5e6f7a8b");
  synthetic::write_builds(rows_path(), {a, b}, {by(a, {"naive", 6, 1, 1.0}), by(b, {"naive", 6, 1, 0.8})});
  const std::string text = compare("1a2b3c4d", "5e6f7a8b");
  EXPECT_CONTAINS(text, "1.250  [1.250, 1.250]  faster\n");
  EXPECT_EQ(text.find("measured apart"), std::string::npos) << text;
}

TEST_F(compared, different_machines_are_refused_unless_allowed) {
  environment_row other = build('2', "GNU 12.2.0");
  other.host = "elsewhere";
  const std::string a = put_build("a.jsonl", build('1', "GNU 12.2.0"), 1.0), b = put_build("b.jsonl", other, 0.5);
  EXPECT_CONTAINS(message_of([&] { compare(a, b); }), "measured on different machines (host (elsewhere, node))");
  EXPECT_CONTAINS(compare(a, b, true), "host (elsewhere, node)");
}

TEST_F(compared, uncommitted_changes_are_refused_unless_allowed) {
  const std::string a = put_build("a.jsonl", build('1', "GNU 12.2.0"), 1.0);
  const std::string b = put_build("b.jsonl", build('2', "GNU 12.2.0", "abc1234", true), 0.5);
  EXPECT_CONTAINS(message_of([&] { compare(a, b); }), "built from a tree with uncommitted changes");
  EXPECT_CONTAINS(compare(a, b, true), "abc1234 with uncommitted changes");
}

TEST_F(compared, wrong_sides_are_refused_in_one_line) {
  write(talk());
  const std::string path = rows_path().string();
  EXPECT_CONTAINS(message_of([&] { compare("naive", "naive"); }), "not \"naive\" twice");
  EXPECT_CONTAINS(message_of([&] { compare(path, "naive"); }), "is a file, \"naive\" is none");
  EXPECT_CONTAINS(message_of([&] { compare("naive", "abc1234"); }), "\"naive\" is a backend, \"abc1234\" a revision");
  EXPECT_CONTAINS(message_of([&] { compare("abc1", "abc1234"); }), "both name the revision abc1234");
  const std::string unknown = message_of([&] { compare("naive", "gather"); });
  EXPECT_CONTAINS(unknown, "\"gather\" is neither a backend nor a revision of these rows; there are the backends");
  EXPECT_CONTAINS(unknown, "symmetric_tbb");
  EXPECT_CONTAINS(unknown, "abc1234");
  EXPECT_CONTAINS(message_of([&] { compare("naive", "naive_omp"); }), "have no point in common");
}

TEST_F(compared, a_file_of_several_builds_is_refused) {
  const environment_row gcc = build('1', "GNU 12.2.0"), clang = build('2', "Clang 14.0.6");
  synthetic::write_builds(file("both.jsonl"), {gcc, clang},
                          {by(gcc, {"naive", 6, 1, 1.0}), by(clang, {"naive", 6, 1, 0.8})});
  const std::string one = put_build("a.jsonl", gcc, 1.0), both = file("both.jsonl").string();
  EXPECT_CONTAINS(message_of([&] { compare(one, both); }), "both.jsonl\" holds rows of several builds");
}

TEST_F(compared, files_without_a_common_point_are_refused) {
  const std::string a = put_build("a.jsonl", build('1', "GNU 12.2.0"), 1.0);
  const std::string b = put_build("b.jsonl", build('1', "GNU 12.2.0"), 1.0, "symmetric");
  EXPECT_CONTAINS(message_of([&] { compare(a, b); }),
                  "have no point in common (same study, case, dx, grid, M, threads, backend)");
}

}  // namespace
}  // namespace pairsum::harness
