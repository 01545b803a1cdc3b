#!/usr/bin/env bash
# Installs what is needed, builds pairsum, verifies it, runs the talk's study, prints tables, draws figures.
set -euo pipefail
script=run_all.sh
called_from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"
source harness/scripts/dependencies.sh
source harness/scripts/steps.sh

usage() {
  cat <<'TEXT'
usage: ./run_all.sh [--quick] [--no-install] [--results DIR] [--jobs N] [--limit SECONDS]

Installs the missing Debian packages, builds the program, verifies it, measures the study of the talk at
full size (2 million particles), prints tables and draws figures. Takes at most 15 minutes after the
installation.

  --quick          a small version of the same in at most 2 minutes
  --no-install     do not look for missing packages
  --results DIR    where results go (default: results, beside this script); every run makes new files
  --jobs N         processes of the build (default: what cores and memory allow)
  --limit SECONDS  time after the installation (default: 900; with --quick 120)

PYTHON names the Python that draws (default: /usr/bin/python3; needs numpy and matplotlib).
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
  limit=${limit:-120} reserve=15 least=20 # seconds: for tables and figures; for the first part in any case
  memory_mb=1000 disk_mb=1000
  dx=0.02
else
  limit=${limit:-900} reserve=45 least=240
  memory_mb=2000 disk_mb=1000
  dx=0.00594
fi
program=build/study/bin/pairsum

shown() { realpath -m --relative-base="$called_from" -- "$1"; }

# ---- what it will take
if $quick; then size="small case"; else size="full size"; fi
say "pairsum: the study of the talk, $size. It takes up to $limit s, $memory_mb MB of memory and $disk_mb MB of disk."
if $install; then say "Packages, if all are missing, take about 2 minutes and 600 MB of disk more."; fi
check_room "$memory_mb" "$disk_mb"

# ---- install
if $install; then
  heading "packages"
  ensure_packages build plots || exit
else
  say "packages: not looked at (--no-install)"
fi
choose_python numpy matplotlib || exit
for tool in cmake git; do
  command -v "$tool" >/dev/null || stop "$exit_missing" "$tool is not installed (run without --no-install)"
done
deadline=$((SECONDS + limit - reserve)) # for measuring

# ---- build
heading "build"
step "configuring the build" cmake --preset study
step "the build" cmake --build --preset study --target pairsum --parallel "${jobs:-$(jobs_for 1000)}"
[[ -x $program ]] || stop 4 "the build made no $program"

# ---- verify
heading "verify: every algorithm against the reference, on a small case"
verified=build/study/verify.txt status=0
in_background "$program" verify --case dam_break --dx 0.05 --state perturbed --each >"$verified" || status=$?
if ((status != 0)); then
  cat "$verified"
  stop "$status" "the verification failed (exit $status)"
fi
tail -n 1 "$verified"

# ---- measure
commit=$(git rev-parse --short=12 HEAD 2>/dev/null || echo nogit)
[[ -z $(git status --porcelain -- kernels harness CMakeLists.txt CMakePresets.json 2>/dev/null) ]] || commit+=-dirty
host=$(uname -n)
stem=${host//[^A-Za-z0-9._-]/_}-$(date -u +%Y%m%dT%H%M%SZ)-$commit
if $quick; then
  first_study="quick"
else
  first_study="talk"
fi

files=() # rows files of this run
# written: those that hold a measurement.
written() { ((${#files[@]} == 0)) || grep -ls '"kind":"sample"' -- "${files[@]}" || true; }
kept() {
  local file separator="; valid rows are kept in "
  while read -r file; do
    printf '%s%s' "$separator" "$(shown "$file")"
    separator=", "
  done < <(written)
}

parallel=naive_omp,symmetric_omp,naive_tbb,symmetric_tbb
serial=naive,pair_list,sphysics_sweep,ppm_stencil,symmetric
all_cores=$(cores)

# part WEIGHT MINIMUM STUDY TITLE ARGUMENT...: measures one part of the study. Of the seconds left it may use the
# share WEIGHT / (weights of this and all later parts); with fewer than MINIMUM left it is left out.
weight_left=23
part() {
  local weight=$1 minimum=$2 study=$3 title=$4
  shift 4
  local left=$((deadline - SECONDS)) out=$results/$study/$stem.jsonl began=$SECONDS status=0
  ((weight_left < 23 || left >= least)) || left=$least # the first part: at least one repetition, however slow the build
  local budget=$((left * weight / weight_left))
  weight_left=$((weight_left - weight))
  heading "measure: $title"
  if ((left < minimum)); then
    say "left out: $((left > 0 ? left : 0)) s are left of the limit, $minimum s are wanted (a larger --limit helps)"
    return
  fi
  [[ " ${files[*]} " == *" $out "* ]] || files+=("$out")
  in_background timeout --kill-after=5 "$left" \
    "$program" run --study "$study" --case dam_break --steps 5 --budget "$budget" --out "$out" "$@" || status=$?
  if ((status == 124 || (status == 137 && SECONDS - began >= left))); then
    warn "'$title' was cut short by the time limit; its rows up to there are kept"
  elif ((status != 0)); then
    stop "$status" "measuring '$title' failed (exit $status)"
  fi
}

say
say "rows go to $(shown "$results/$first_study/$stem.jsonl")"
if $quick; then
  part 11 1 quick "parallel algorithms, at rest" --dx $dx --state rest --backend $parallel --M 6,7 \
    --threads all --repetitions 3
  part 6 5 quick "parallel algorithms, perturbed" --dx $dx --state perturbed --backend $parallel --M 6,7 \
    --threads all --repetitions 2
  part 3 5 quick "serial algorithms" --dx $dx --state rest --backend $serial --M 6,7 --threads 1 --repetitions 2
  part 3 5 quick "M from 2 to 9" --dx 0.03 --state rest --backend naive_omp,symmetric_omp --M 2,3,4,5,6,7,8,9 \
    --threads "$all_cores" --repetitions 2
else
  part 11 1 talk "parallel algorithms, at rest (the talk's points)" --dx $dx --state rest --backend $parallel \
    --M 6,7 --threads all --repetitions 6
  part 6 120 talk "parallel algorithms, perturbed" --dx $dx --state perturbed --backend $parallel --M 6,7 \
    --threads all --repetitions 6
  part 3 75 talk "serial algorithms" --dx $dx --state rest --backend $serial --M 6,7 --threads 1 --repetitions 6
  part 2 55 m_sweep "M at full size" --dx $dx --state rest --backend naive_omp,symmetric_omp \
    --M 5,6,7,8,9 --threads "$all_cores" --repetitions 6
  part 1 10 m_sweep "M from 2, small case" --dx 0.02 --state rest --backend naive_omp,symmetric_omp \
    --M 2,3,4,5,6,7,8,9 --threads "$all_cores" --repetitions 6
fi

# ---- tables and figures
mapfile -t found < <(written)
((${#found[@]} > 0)) || stop 4 "nothing was measured within $limit s (a larger --limit helps)"
heading "tables"
for file in "${found[@]}"; do # one folder per study, named like its rows
  folder=${file%.jsonl}
  mkdir -p "$folder"
  step "the report" "$program" report "$file" --summary "$folder/summary.json" >"$folder/tables.txt"
  cat "$folder/tables.txt"
done
heading "figures"
export PYTHONDONTWRITEBYTECODE=1
for file in "${found[@]}"; do
  step "drawing the figures" "$PYTHON" plots/plot.py "${file%.jsonl}/summary.json" --out "${file%.jsonl}"
done

heading "done"
for file in "${found[@]}"; do
  folder=$(shown "${file%.jsonl}")
  say "rows:    $(shown "$file")"
  say "tables:  $folder/tables.txt"
  say "summary: $folder/summary.json"
  say "figures: $folder/*.svg, *.png"
done
