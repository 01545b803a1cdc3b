#!/bin/sh
# Runs race_main under ThreadSanitizer with Archer and judges what it says.
#
#   check.sh clean PROGRAM ARCHER RUNTIME                  all of the library: status 0, done, not one report
#   check.sh clean PROGRAM ARCHER ranks omp                the same on two ranks
#   check.sh planted PROGRAM ARCHER RUNTIME NAME ISA       NAME is racy: a data race must be reported, in the phase sum, not before
#
# ARCHER is libarcher.so, which tells ThreadSanitizer what OpenMP synchronises; libomp itself is not instrumented.
set -u
mode=$1 program=$2 archer=$3 runtime=$4
shift 4
what="${*:-$runtime}"
ranks=
if [ "$runtime" = ranks ]; then
  ranks="sh $(dirname "$0")/../ranks/run_ranks.sh mpirun 2"
  what="ranks $*"
fi
race_status=66
output=$(mktemp) || exit 1
trap 'rm -f "$output"' EXIT

fail() {
  echo "races: $what: $*"
  echo "--- the last lines of the program"
  tail -n 120 "$output"
  exit 1
}

unset OMP_THREAD_LIMIT OMP_NUM_THREADS OMP_PROC_BIND OMP_PLACES OMP_TOOL
export OMP_DYNAMIC=false OMP_WAIT_POLICY=passive OMP_TOOL_LIBRARIES="$archer" ARCHER_OPTIONS="verbose=1"
# history_size: ThreadSanitizer drops a race without a word if it has forgotten where the earlier of the
# two accesses was made. What it keeps by default is shorter than a pass, and then a missing barrier is
# reported after minutes, if at all; 300 parts hold a whole summation (75 MiB a thread).
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=$race_status halt_on_error=1 history_size=300"
# ThreadSanitizer wants its addresses where it expects them, which newer kernels' randomisation prevents.
fixed=
if setarch "$(uname -m)" -R true 2>/dev/null; then fixed="setarch $(uname -m) -R"; fi

# shellcheck disable=SC2086  # all are words
$fixed $ranks "$program" $what >"$output" 2>&1
status=$?
[ "$runtime" = tbb ] || grep -qi 'archer detected' "$output" || fail "Archer is not detected ($archer); install libomp-14-dev"
case $mode in
  clean)
    ! grep -q 'WARNING: ThreadSanitizer' "$output" || fail "ThreadSanitizer reports"
    [ $status -eq 0 ] || fail "exits with $status"
    grep -q "^race_main: done\$" "$output" || fail "did not finish"
    grep '^race_main: .* fluid particles' "$output"
    echo "races: $what: no report"
    ;;
  planted)
    [ $status -eq $race_status ] || fail "exits with $status, not with $race_status"
    grep -q 'WARNING: ThreadSanitizer: data race' "$output" || fail "no data race reported"
    if [ -n "$ranks" ]; then # whose phases are told in turns
      grep -q "races::.*one_colour.*unit" "$output" || fail "the report is not of the planted backend's units"
      echo "races: planted $what: data race reported in its units"
      exit 0
    fi
    phase=$(sed -n '/WARNING: ThreadSanitizer/q; s/^race_main: .* phase //p' "$output" | tail -n 1)
    [ "$phase" = sum ] || fail "the report is of phase ${phase:-(none)}, not of sum"
    echo "races: planted $what: data race reported in phase sum"
    ;;
  *)
    echo "usage: check.sh clean|planted PROGRAM ARCHER RUNTIME [NAME ISA]" >&2
    exit 2
    ;;
esac
