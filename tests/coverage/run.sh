#!/bin/sh
# Which lines of the library and the program the tests reach, by gcovr: sh tests/coverage/run.sh [BUILD]
# Six minutes on 2 cores. Prints the figures; build/coverage/coverage.txt has them file by file.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$source/build/coverage}
command -v gcovr >/dev/null || {
  echo "coverage: gcovr is missing; on Debian 12: apt-get install -y --no-install-recommends gcovr"
  exit 3
}
cmake --preset coverage -S "$source" -B "$build"
find "$build" -name '*.gcda' -delete
cmake --build "$build" --parallel 2 --target test_kernels test_harness test_tune test_rows rows_example stats_of pairsum \
  pairsum_bench
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel 2 \
  --exclude-regex '^(layers|headers|tidy|plots|results|scripts|kernels_full_size|accuracy.*)$'
gcovr --root "$source" --object-directory "$build" --filter "$source/kernels/" --filter "$source/harness/" \
  --exclude-throw-branches --gcov-ignore-parse-errors --txt "$build/coverage.txt" --print-summary
