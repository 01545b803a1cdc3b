#!/bin/sh
# Builds and runs the tests with the preset asan, then says how much of the code they cover: run_asan.sh SOURCE BUILD
set -eu
source=$1 build=$2
least=90 # percent of the lines of kernels/ and harness/

command -v gcovr >/dev/null || {
  echo "asan: gcovr is missing; on Debian 12: apt-get install -y --no-install-recommends gcovr"
  exit 1
}
mkdir -p "$build"
python=$(command -v /usr/bin/python3 || command -v python3)
cmake --preset asan -S "$source" -B "$build" -DPython3_EXECUTABLE="$python" \
  >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log"
  exit 1
}
find "$build" -name '*.gcda' -delete
cmake --build "$build" --parallel 2 --target test_kernels test_harness test_rows rows_example test_report test_stats pairsum \
  >"$build/build.log" 2>&1 || {
  grep -E 'error|FAILED' "$build/build.log" || cat "$build/build.log"
  exit 1
}
ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
  ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel 2 \
  --exclude-regex '^(layers|headers|tidy|plots|scripts|kernels_full_size|accuracy.*)$' --timeout 600
gcovr --root "$source" --object-directory "$build" --filter "$source/kernels/" --filter "$source/harness/" \
  --exclude-throw-branches --fail-under-line "$least" --txt "$build/coverage.txt" --print-summary
