#!/usr/bin/env bash
# Installs what is needed, builds everything with its tests, runs the tests. Ends with ctest's summary.
set -euo pipefail
script=run_tests.sh
cd "$(dirname "${BASH_SOURCE[0]}")"
source harness/scripts/dependencies.sh
source harness/scripts/steps.sh

usage() {
  cat <<'TEXT'
usage: ./run_tests.sh [--fast] [--no-install] [--jobs N] [--limit SECONDS]

Installs the missing Debian packages, builds preset test and runs every test. The last lines are ctest's
summary, the exit code is ctest's (0: all passed).

  --fast           leave out what builds the project anew (sanitizers, races, packages, clang-tidy, counted instructions) and
                   the full-size case: a few minutes once the build is there
  --no-install     do not look for missing packages
  --jobs N         processes of the build, and tests at a time (default: what cores and memory allow)
  --limit SECONDS  after so long no test goes on, and those left count as failed (default: 4500)

PYTHON names the Python of the tests (default: /usr/bin/python3; needs pytest, jsonschema, pandas, scipy,
matplotlib, jinja2, selenium).
Exit code also: 2 bad input; 3 something needed is not installed; that of the build if it fails.
TEXT
}

install=true jobs='' limit=4500 fast=()
while (($# > 0)); do
  case $1 in
    --no-install) install=false ;;
    --fast) fast=(--label-exclude 'leg|full') ;;
    --jobs | --limit)
      need_value "$1" $#
      need_count "$1" "$2"
      declare "${1#--}=$2"
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) stop 2 "unknown option '$1' (see --help)" ;;
  esac
  shift
done

say "pairsum: every test. It takes up to $((limit / 60)) minutes, 4000 MB of memory and 3000 MB of disk."
if $install; then say "Packages, if all are missing, take 1 GB of disk more."; fi
check_room 4000 3000

if $install; then
  heading "packages"
  ensure_packages build plots tests || exit
else
  say "packages: not looked at (--no-install)"
fi
choose_python pytest jsonschema pandas scipy matplotlib jinja2 selenium || exit
command -v cmake >/dev/null || stop "$exit_missing" "cmake is not installed (run without --no-install)"

heading "build"
step "configuring the build" cmake --preset test -DPython3_EXECUTABLE="$PYTHON"
step "the build" cmake --build --preset test --parallel "${jobs:-$(jobs_for 1500)}"

heading "tests"
left=$((limit - SECONDS))
((left > 0)) || stop 4 "the build took all of the $limit s, no test was run"
stop_time=$(date -d "now + $left seconds" +%H:%M:%S)
# Tests run side by side: a thread that waits must leave its core to others.
export OMP_WAIT_POLICY=passive
status=0
in_background ctest --preset test --no-tests=error "${fast[@]}" --parallel "${jobs:-$(jobs_for 2000)}" \
  --stop-time "$stop_time" || status=$?
exit "$status"
