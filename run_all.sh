#!/usr/bin/env bash
# Installs what is needed, builds pairsum, verifies it, carries out the talk's study, says what is fastest here.
set -euo pipefail
script=run_all.sh
called_from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"
source harness/scripts/dependencies.sh
source harness/scripts/steps.sh

usage() {
  cat <<'TEXT'
usage: ./run_all.sh [--quick] [--no-install] [--results DIR] [--jobs N] [--limit SECONDS]

Installs the missing Debian packages, builds the program, verifies it, carries out the studies talk (2 million
particles) and m_sweep, and says what is fastest on this machine. Takes at most 15 minutes after the build, which
takes about 3.

  --quick          the study quick, a small version of the same: at most 2 minutes after the build
  --no-install     do not look for missing packages
  --results DIR    where results go (default: results, beside this script); every run makes new files
  --jobs N         processes of the build (default: what cores and memory allow)
  --limit SECONDS  time after the build (default: 900; with --quick 120)

What every step prints goes to build/log/. PYTHON names the Python that reports (default: /usr/bin/python3; needs
pandas, scipy, matplotlib, jinja2).
Exit code: 0; 1 a verification failed; 2 bad input; 3 something needed is not installed; 4 nothing was
measured; 130 interrupted; else that of the step that failed. docs/running.md says more.
TEXT
}

# ---- options
quick=false install=true results=results jobs='' limit=''
while (($# > 0)); do
  case $1 in
    --quick) quick=true ;;
    --no-install) install=false ;;
    --results)
      need_value "$1" $#
      results=$(cd "$called_from" && realpath -m -- "$2")
      shift
      ;;
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

# ---- what differs between the full and the quick run
if $quick; then
  limit=${limit:-120} reserve=30 least=20 # seconds: for tables, figures and page; for the first study in any case
  memory_mb=1000 disk_mb=1000
  study="quick"
else
  limit=${limit:-900} reserve=50 least=240
  memory_mb=2000 disk_mb=1000
  study="talk"
fi
program=build/study/bin/pairsum logs=build/log

shown() { realpath -m --relative-base="$called_from" -- "$1"; }

# ---- what it will take
if $quick; then size="a small case"; else size="full size"; fi
say "pairsum: what is fastest on this machine? The study $study, $size: up to $limit s after the build (about 3 minutes)."
check_room "$memory_mb" "$disk_mb"

# ---- install
mkdir -p "$logs"
packages_log=$logs/packages.txt
if $install; then
  ensure_packages build plots || exit
else
  say "packages: not looked at (--no-install)"
fi
choose_python pandas scipy matplotlib jinja2 || exit
for tool in cmake git; do
  command -v "$tool" >/dev/null || stop "$exit_missing" "$tool is not installed (run without --no-install)"
done

# ---- build
began=$SECONDS
logged "configuring the build" "$logs/configure.txt" cmake --preset study
logged "the build" "$logs/build.txt" \
  cmake --build --preset study --target pairsum --parallel "${jobs:-$(jobs_for 1000)}"
[[ -x $program ]] || stop 4 "the build made no $program"
say "build: $((SECONDS - began)) s"
deadline=$((SECONDS + limit - reserve)) # for measuring

# ---- verify
logged "the verification" "$logs/verify.txt" \
  "$program" verify --case dam_break --dx 0.05 --state perturbed --M 3,6 --threads 1,3 --each
say "verify: $(tail -n 1 "$logs/verify.txt")"

# ---- measure
commit=$(git rev-parse --short=12 HEAD 2>/dev/null || echo nogit)
[[ -z $(git status --porcelain -- kernels harness CMakeLists.txt CMakePresets.json 2>/dev/null) ]] || commit+=-dirty
host=$(uname -n)
stem=${host//[^A-Za-z0-9._-]/_}-$(date -u +%Y%m%dT%H%M%SZ)-$commit

files=()     # rows files of this run
under_way='' # the study that is being measured
rows_of() { printf '%s/%s/%s.jsonl' "$results" "$1" "$stem"; }
# written: those that hold a finished round.
written() { ((${#files[@]} == 0)) || grep -ls '"kind":"round"' -- "${files[@]}" || true; }
kept() {
  local file separator="; finished rounds are kept in "
  while read -r file; do
    printf '%s%s' "$separator" "$(shown "$file")"
    separator=", "
  done < <(written)
  if [[ -n $under_way ]]; then
    printf '; to go on: %s run %s --out %q' "$(shown "$program")" "$under_way" "$(shown "$(rows_of "$under_way")")"
  fi
}

# measure STUDY BUDGET LEFT: carries out a plan of the program within so many seconds; after LEFT it is stopped.
measure() {
  local study=$1 budget=$2 left=$3 out began=$SECONDS status=0
  out=$(rows_of "$study")
  files+=("$out")
  under_way=$study
  # In a session of its own, so that Ctrl-C reaches this script alone, which ends the program once. Its progress stays
  # on the screen.
  in_background setsid timeout --foreground --kill-after=5 "$left" \
    "$program" run "$study" --budget "$budget" --out "$out" >"$logs/run_$study.txt" || status=$?
  if ((status == 124 || (status == 137 && SECONDS - began >= left))); then
    warn "the study $study was cut short by the time limit; its finished rounds are kept"
  elif ((status != 0)); then
    grep -m 3 FAILED "$logs/run_$study.txt" >&2 || tail -n 3 "$logs/run_$study.txt" >&2
    stop "$status" "measuring the study $study failed (exit $status); all of its output: $logs/run_$study.txt"
  fi
  under_way=''
  say "measure: $study, $((SECONDS - began)) s, rows in $(shown "$out")"
}

left=$((deadline - SECONDS))
((left >= least)) || left=$least # at least one round, however slow the verification
if $quick; then
  measure "$study" $((left - left / 20)) "$left"
else
  measure "$study" $((left * 4 / 5)) "$left"
  left=$((deadline - SECONDS)) least=75 # every point verified, one round
  if ((left < least)); then
    say "measure: m_sweep is left out: $((left > 0 ? left : 0)) s are left, $least s are wanted (a larger --limit helps)"
  else
    measure m_sweep $((left - left / 20)) "$left"
  fi
fi

# ---- tables, figures and page: one folder per study, named like its rows
mapfile -t found < <(written)
((${#found[@]} > 0)) || stop 4 "nothing was measured within $limit s (a larger --limit helps)"
export PYTHON
began=$SECONDS
for file in "${found[@]}"; do
  logged "the report" "$logs/report_$(basename "$(dirname "$file")").txt" "$program" report "$file"
done
say "report: $((SECONDS - began)) s; what every step printed: $(shown "$logs")/"

# ---- the answer of the first study, then where the pages lie
say
grep -v '^\(tables\|figures\|page\): ' "$logs/report_$(basename "$(dirname "${found[0]}")").txt" |
  sed -E "s#  pairsum (run|tune)#  $(shown "$program") \1#"
say
for file in "${found[@]}"; do say "look at it: $(shown "${file%.jsonl}/report.html")"; done
