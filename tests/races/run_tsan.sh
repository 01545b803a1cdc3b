#!/bin/sh
# Configures, builds and runs the race tests with the preset tsan: run_tsan.sh SOURCE BUILD
set -eu
source=$1 build=$2

need() { # WHAT PACKAGES
  echo "races: $1 is missing; on Debian 12: apt-get install -y --no-install-recommends $2"
  exit 1
}
all="clang-14 libclang-rt-14-dev libomp-14-dev"
command -v clang++-14 >/dev/null || need "clang++-14" "$all"
command -v ninja >/dev/null || need "ninja" "ninja-build"

# Neither part is a program that could be looked for: compile with each.
mkdir -p "$build"
probe="$build/probe.out"
compiles() { # CODE FLAGS...
  code=$1
  shift
  echo "$code" | clang++-14 -x c++ - -o "$probe" "$@" >/dev/null 2>&1
}
compiles 'int main() {}' -fsanitize=thread || need "ThreadSanitizer's run-time library" "libclang-rt-14-dev"
compiles '#include <omp.h>
int main() { return omp_get_max_threads() < 1; }' -fopenmp || need "libomp" "libomp-14-dev"
rm -f "$probe"

cmake --preset tsan -S "$source" -B "$build" >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log"
  exit 1
}
sed -n 's/^-- \(No oneTBB.*\)/races: \1/p' "$build/configure.log"
cmake --build "$build" --parallel 2 --target race_main >"$build/build.log" 2>&1 || {
  grep -E 'error|FAILED' "$build/build.log" || cat "$build/build.log"
  exit 1
}
# Two at a time: each has four threads, which take turns for most of the time.
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel 8
