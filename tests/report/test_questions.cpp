#include "tests/report/report_fixture.hpp"

// The talk's questions, answered in words.
namespace pairsum::harness {
namespace {

class questions_of : public report {
 protected:
  /// The answer to the question that begins like this; empty if it was not asked.
  static std::string answer_to(const json& summary, const std::string& begin) {
    for (const json& q : summary["questions"])
      if (q["question"].get<std::string>().starts_with(begin)) return q["answer"];
    return "";
  }
};

TEST_F(questions_of, what_was_not_measured_is_not_asked) {
  EXPECT_TRUE(summary_of({{"naive", 7, 1, 1.0}})["questions"].empty());
}

TEST_F(questions_of, twice_as_fast_is_said_with_its_figures) {
  const json s = summary_of({{"naive_omp", 7, 2, 1.0}, {"symmetric_omp", 7, 2, 0.5}});
  EXPECT_EQ(s["questions"].size(), 1u);
  const std::string text = answer_to(s, "Is the symmetric sum twice as fast");
  EXPECT_EQ(text.find("Yes, on 2 threads: OpenMP naive M = 7 over symmetric M = 7: 2.00 [2.00, 2.00]."), 0u) << text;
}

TEST_F(questions_of, less_than_twice_is_no) {
  const json s = summary_of({{"naive", 7, 1, 1.0}, {"symmetric", 7, 1, 0.625}});
  EXPECT_CONTAINS(answer_to(s, "Is the symmetric"), "No, 1.60 times, on 1 thread: serial naive M = 7");
}

TEST_F(questions_of, several_speedups_are_said_as_a_range) {
  const json s =
      summary_of({{"naive", 6, 1, 1.0}, {"symmetric", 6, 1, 0.8}, {"naive", 7, 1, 0.9}, {"symmetric", 7, 1, 0.6}});
  EXPECT_CONTAINS(answer_to(s, "Is the symmetric"), "No, 1.12 to 1.50 times, on 1 thread");
}

/// Points that differ in the instruction set or in the blocks alone are told apart by them; what is the same in all is
/// not repeated. A gather is set against the symmetric sum with the same.
TEST_F(questions_of, blocks_and_instruction_sets_tell_speedups_apart) {
  const auto tiles = [](const char* isa, const char* block, double gather, double symmetric) {
    const auto with = [=](sample& s) {
      s.point.isa = isa, s.point.block = block;
      if (s.work) s.work->vector_units = {block, 8, 1000, 0.8};
    };
    return std::vector<made_point>{{"naive_tiles_omp", 7, 2, gather, 6, with}, {"tiles_omp", 7, 2, symmetric, 6, with}};
  };
  const auto answer = [&](std::vector<std::vector<made_point>> all) {
    std::vector<made_point> points{{"naive_omp", 7, 2, 2.0}, {"symmetric_omp", 7, 2, 1.6}};
    for (const auto& some : all) points.insert(points.end(), some.begin(), some.end());
    std::filesystem::remove(rows_path());
    return answer_to(summary_of(points), "Is the symmetric");
  };
  EXPECT_CONTAINS(answer({tiles("avx2", "auto", 1.0, 0.8)}), "naive_tiles M = 7 over tiles M = 7: 1.25");
  const std::string blocks = answer({tiles("avx2", "auto", 1.0, 0.8), tiles("avx2", "slab:4", 1.2, 0.5)});
  EXPECT_CONTAINS(
      blocks,
      "naive M = 7 over symmetric M = 7: 1.25 [1.25, 1.25], OpenMP naive_tiles M = 7 over tiles M = 7, auto: "
      "1.25 [1.25, 1.25], OpenMP naive_tiles M = 7 over tiles M = 7, slab:4: 2.40 [2.40, 2.40].");
  EXPECT_CONTAINS(
      answer({tiles("avx2", "auto", 1.0, 0.8), tiles("sse4", "auto", 1.5, 0.5)}),
      "naive_tiles M = 7 over tiles M = 7, avx2: 1.25 [1.25, 1.25], OpenMP naive_tiles M = 7 over tiles M = "
      "7, sse4: 3.00 [3.00, 3.00].");
  const auto vector = [](sample& s) {
    s.point.isa = "avx2";
    if (s.work) s.work->vector_units = {"none", 4, 1000, 0.8};
  };
  EXPECT_CONTAINS(answer({{{"naive_omp", 7, 2, 0.6, 6, vector}, {"symmetric_omp", 7, 2, 0.8, 6, vector}}}),
                  "OpenMP naive M = 7 over symmetric M = 7, avx2: 0.75 [0.75, 0.75], OpenMP naive M = 7 over symmetric "
                  "M = 7, scalar: 1.25 [1.25, 1.25].");
}

TEST_F(questions_of, not_faster_is_said) {
  const json s = summary_of({{"naive", 7, 1, 1.0}, {"symmetric", 7, 1, 1.25}});
  EXPECT_CONTAINS(answer_to(s, "Is the symmetric"), "No, it is not faster");
}

TEST_F(questions_of, scaling_names_both_kinds_the_machine_and_the_waiting) {
  const auto waiting = [](sample& s) {
    s.threads_busy_s = thread_times{{0.3, 0.3}};
    s.barrier_wait_s = thread_times{{0.2, 0.0}};
  };
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    peak_row p = example::peak();
    writer.write(p);
    p.threads = 1;
    p.flops_per_s = 5e10;
    writer.write(p);
    synthetic::write_rounds(writer, {{"naive_omp", 7, 1, 1.0},
                                     {"naive_omp", 7, 2, 0.5},
                                     {"symmetric_omp", 7, 1, 0.75},
                                     {"symmetric_omp", 7, 2, 0.5, 6, waiting},
                                     {"again_naive_omp", 7, 1, 1.0},
                                     {"again_naive_omp", 7, 2, 0.25}});
  }
  const std::string text = answer_to(make(), "Does it scale");
  EXPECT_CONTAINS(text, "On 2 threads gathers are 2.00 times as fast as on one, symmetric sums 1.50 times");
  EXPECT_CONTAINS(text, "naive_omp M = 7: 2.00 [2.00, 2.00]");
  EXPECT_CONTAINS(text, "The machine itself does 1.90 times as many multiply-adds.");
  EXPECT_CONTAINS(text, "threads spend 25.0 % of the time waiting at barriers");
  EXPECT_EQ(text.find("again_"), std::string::npos) << text;
}

TEST_F(questions_of, scaling_is_set_against_the_paces_of_the_rounds) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    synthetic::write_paces(writer, 4e10, 8e10);
    synthetic::write_rounds(writer, {{"naive_omp", 7, 1, 1.0},
                                     {"naive_omp", 7, 2, 0.5},
                                     {"symmetric_omp", 7, 1, 0.75},
                                     {"symmetric_omp", 7, 2, 0.5}});
  }
  const std::string text = answer_to(make(), "Does it scale");
  EXPECT_CONTAINS(text, "In the same rounds the machine itself made 2.00 times as many multiply-adds");
  EXPECT_CONTAINS(text, "naive_omp M = 7: 1.00 [1.00, 1.00], symmetric_omp M = 7: 0.75 [0.75, 0.75].");
}

TEST_F(questions_of, scaling_of_many_backends_is_said_of_the_least_and_the_greatest) {
  std::vector<made_point> timings;
  for (const char* backend : {"naive_omp", "naive_tbb", "symmetric_omp", "symmetric_tbb", "tiles_omp", "colour4",
                              "colour18", "sliced_locks", "atomic_add"}) {
    timings.push_back({backend, 7, 1, 1.0});
    const double speedup =
        std::string(backend) == "atomic_add" ? 1.25 : 1.6 + 0.01 * static_cast<double>(timings.size());
    timings.push_back({backend, 7, 2, 1.0 / speedup});
  }
  const std::string text = answer_to(summary_of(timings), "Does it scale");
  EXPECT_CONTAINS(
      text, "(from atomic_add M = 7: 1.25 [1.25, 1.25] to sliced_locks M = 7: 1.75 [1.75, 1.75], 7 others between)");
  EXPECT_EQ(text.find("colour4"), std::string::npos) << text;
}

TEST_F(questions_of, which_M_is_said_of_as_many_threads) {
  const json s = summary_of({{"symmetric_omp", 6, 2, 0.5},
                             {"symmetric_omp", 7, 2, 0.4},
                             {"symmetric_omp", 8, 2, 0.4},
                             {"symmetric_omp", 9, 1, 0.1}});  // on 1 thread, one M alone
  const std::string text = answer_to(s, "Which M");
  EXPECT_CONTAINS(text,
                  "symmetric_omp M = 7 (840.00 ms a step; M = 6 takes 1.25 times as long; no difference resolved "
                  "from M = 8)");
  EXPECT_CONTAINS(text, "Of the symmetric sums: M = 6: 25 % in 100 cells");
  EXPECT_EQ(text.find("M = 9"), std::string::npos);
}

TEST_F(questions_of, openmp_or_onetbb_counts_verdicts) {
  const json s = summary_of({{"naive_omp", 7, 2, 1.0},
                             {"naive_tbb", 7, 2, 1.0},
                             {"symmetric_omp", 7, 2, 0.6},
                             {"symmetric_tbb", 7, 2, 0.5},
                             {"symmetric_omp", 7, 1, 0.6},
                             {"symmetric_tbb", 7, 1, 0.8}});
  EXPECT_EQ(answer_to(s, "OpenMP or oneTBB?"),
            "Of 3 comparisons oneTBB is faster in 1, OpenMP in 1, no difference is resolved in 1; OpenMP's time is "
            "0.750 to 1.200 of oneTBB's.");
}

}  // namespace
}  // namespace pairsum::harness
