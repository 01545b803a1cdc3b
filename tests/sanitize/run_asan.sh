#!/bin/sh
# Builds with the preset asan and runs tests of the library, of rows and of statistics, then the fuzzers of the readers of files, 20 s each:
# run_asan.sh SOURCE BUILD
# clang compiles sanitized templates in half the time of g++. Left out are tests that only repeat these on more particles, which take hours
# here (the brute force of a verification is slow), and the program, which takes long to compile. It can be
# built and tried by hand: cmake --build --preset asan --target pairsum. Not reached besides: interactions of one's own, and arithmetic
# alone (smoothing kernels, monaghan94 by hand, the running error); oscillators are summed in 3D and double, formulas with fewer M and teams.
set -eu
source=$1 build=$2
kernels='formula_matrix|edge_cases|few_particles|clouds_test|symmetries|integrat|lost|counting_sort|reorderer|indexer|hashed_grid'
kernels="$kernels|lanes_test|lanes[.]|isa_test|teams|mixed_test|mixed[.]|cell_blocks|block_choice|block_shape|check_input|registry|random|agreement|ferrari09|broken"
results='words|rows|row_'
# What takes half a minute each.
slow='coincide.*(tbb|naive)'

mkdir -p "$build"
cmake --preset asan -S "$source" -B "$build" >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log"
  exit 1
}
cmake --build "$build" --parallel 2 --target test_kernels test_rows test_ranks fuzz_rows fuzz_plans fuzz_profiles fuzz_csv fuzz_bi4 fuzz_planted \
  >"$build/build.log" 2>&1 || {
  grep -E 'error|FAILED' "$build/build.log" || cat "$build/build.log"
  exit 1
}

# run PROGRAM: those of its tests whose names match, in two processes. A process for each test would spend more time on
# starting and on looking for leaks than on testing.
run() {
  program=$1
  "$build/bin/$program" --gtest_list_tests >"$build/$program.tests"
  awk -v wanted="$kernels|$results" -v slow="$slow" '
    /^[^ ].*[.]( |$)/ { suite = $1; type = $0 }
    /^  / { name = suite $1
      if ((name $0 type) ~ wanted && (name $0 type) !~ slow) filter = filter ":" name }
    END { print "--gtest_filter=" substr(filter, 2) }' "$build/$program.tests" >"$build/$program.flags"
  if grep -qx -e '--gtest_filter=' "$build/$program.flags"; then
    echo "asan: no test of $program is chosen"
    exit 1
  fi
  shards='' status=0
  for shard in 0 1; do
    GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$shard "$build/bin/$program" "--gtest_flagfile=$build/$program.flags" --gtest_brief=1 \
      >"$build/$program.$shard.log" 2>&1 &
    shards="$shards $!"
  done
  for shard in $shards; do wait "$shard" || status=$?; done
  tail -qn 300 "$build/$program".[01].log
  if [ $status -ne 0 ]; then exit "$status"; fi
}

export LSAN_OPTIONS="suppressions=$source/tests/sanitize/leaks.txt:print_suppressions=0"
export ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1
# As the preset has them for ctest: few random cases, the same each time; threads that wait leave their core to others.
export RC_PARAMS="seed=2009 max_success=20" OMP_WAIT_POLICY=passive
for program in test_rows test_kernels; do run "$program"; done
# On two ranks; without a look for leaks, which MPI has in modules that it unloads before the end.
some='*/tiles_tbb:*/touched_blocks:*/half_cells'
ASAN_OPTIONS="$ASAN_OPTIONS:detect_leaks=0" sh "$source/tests/ranks/run_ranks.sh" mpirun 2 "$build/bin/test_ranks" --gtest_brief=1 \
  "--gtest_filter=domain.*:exchange.*:closed_forms.*:modes.*:moving.*:$some"
sh "$source/tests/fuzz/run_fuzzers.sh" "$build/bin" "$source/tests/fuzz/corpus" 20 "$build/fuzz"
