# shellcheck shell=bash
# What run_all.sh and run_tests.sh share: messages, steps that can be interrupted, sizes of the machine.
# To be sourced by a script that has set `script` to its name.
# shellcheck disable=SC2154

child=   # process of the step that is running
watcher= # process that shows how far it is
elapsed_from=$SECONDS

say() { printf '%s\n' "$*"; }
warn() { printf '%s: warning: %s\n' "$script" "$*" >&2; }

# heading TEXT: a line that starts a step, with the seconds since the beginning.
heading() { printf '\n== %s (at %d s)\n' "$*" $((SECONDS - elapsed_from)); }

# kept: prints what is safe if the script ends early; a script may define its own.
kept() { :; }

# stop STATUS TEXT: ends the script with one line.
stop() {
  printf '%s: %s%s\n' "$script" "$2" "$(kept)" >&2
  exit "$1"
}

# in_background COMMAND...: runs the program without input, so that a signal to this script is handled at once.
# (A background process of a script ignores SIGINT; env takes that back.)
in_background() {
  local status=0
  env --default-signal=INT "$@" </dev/null &
  child=$!
  wait "$child" || status=$?
  child=
  return "$status"
}

# step NAME COMMAND...: runs it; a failure stops the script with the command's exit code.
step() {
  local name=$1 status=0
  shift
  in_background "$@" || status=$?
  ((status == 0)) || stop "$status" "$name failed (exit $status)"
}

# logged NAME LOG COMMAND...: the same with its output in a file; on a terminal a line shows how far it is.
logged() {
  local name=$1 log=$2 status=0
  shift 2
  mkdir -p "$(dirname "$log")"
  if [[ -t 2 ]]; then
    watch_log "$name" "$log" &
    watcher=$!
  fi
  in_background "$@" >"$log" 2>&1 || status=$?
  end_watcher
  ((status == 0)) || {
    tail -n 15 "$log" >&2
    stop "$status" "$name failed (exit $status); all of its output: $log"
  }
}

# watch_log NAME LOG: every second, in one line, the seconds that went by and, where the log counts steps as [3/62], how
# many are done and how long the others may take.
watch_log() {
  local began=$SECONDS text width passed
  while sleep 1; do
    passed=$((SECONDS - began))
    text="$1: $passed s"
    if [[ $(tail -c 400 "$2" 2>/dev/null) =~ .*\[([0-9]+)/([0-9]+)\] ]] && ((BASH_REMATCH[1] > 0)); then
      text+=", step ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
      text+=", about $((passed * (BASH_REMATCH[2] - BASH_REMATCH[1]) / BASH_REMATCH[1])) s left"
    fi
    width=$(stty size <&2 2>/dev/null | cut -d' ' -f2)
    printf '\r\033[K%.*s' $((${width:-80} - 1)) "$text" >&2
  done
}

end_watcher() {
  [[ -n $watcher ]] || return 0
  kill "$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || true
  watcher=
  printf '\r\033[K' >&2
}

# on_signal STATUS: ends the running step, then the script. A second signal ends the script at once.
on_signal() {
  trap - INT TERM HUP
  end_watcher
  if [[ -n $child ]]; then
    kill -TERM "$child" 2>/dev/null || true
    wait "$child" 2>/dev/null || true
  fi
  echo >&2
  stop "$1" "interrupted"
}
trap 'on_signal 130' INT
trap 'on_signal 143' TERM
trap 'on_signal 129' HUP

# need_value OPTION COUNT: an option that takes a value must have one.
need_value() { (($2 > 1)) || stop 2 "$1 needs a value (see --help)"; }

# need_count OPTION VALUE: the value must be a whole number from 1.
need_count() { [[ $2 =~ ^[1-9][0-9]{0,5}$ ]] || stop 2 "$1 needs a whole number from 1, not '$2'"; }

# groups_of CONTROLLER: the folders of the control groups, of version 1 or 2, that this job is in, and of those above.
groups_of() {
  local controllers group top
  while IFS=: read -r _ controllers group; do
    top=${system_root:-}/sys/fs/cgroup
    if [[ -z $controllers ]]; then
      [[ ! -d $top/unified ]] || top+=/unified
    elif [[ ,$controllers, == *,$1,* ]]; then
      top+=/$controllers
    else
      continue
    fi
    until [[ -z $group ]]; do
      echo "$top$group"
      group=${group%/*}
    done
    echo "$top"
  done <"${system_root:-}/proc/self/cgroup"
}

# numbers_in FOLDER FILE...: the numbers with which the files begin, if each begins with one.
numbers_in() {
  local folder=$1 file number numbers=
  shift
  for file in "$@"; do
    read -r number _ 2>/dev/null <"$folder/$file" || true
    [[ ${number:-} =~ ^[0-9]+$ ]] || return 0
    numbers+="$number "
    number=
  done
  echo "$numbers"
}

# cores: how many this job may use at the same time: taskset and the quota of a container count.
cores() {
  local all folder max quota period
  all=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
  while read -r folder; do
    read -r max 2>/dev/null <"$folder/cpu.max" || max=$(numbers_in "$folder" cpu.cfs_quota_us cpu.cfs_period_us)
    read -r quota period <<<"$max"
    [[ $quota =~ ^[1-9][0-9]*$ && $period =~ ^[1-9][0-9]*$ ]] || continue
    ((quota / period >= all)) || all=$((quota / period))
  done < <(groups_of cpu)
  ((all >= 1)) || all=1
  echo "$all"
}

# free_memory_mb, free_disk_mb: what is available here; a container's own memory limit counts.
free_memory_mb() {
  local free folder limit used
  free=$(awk '$1 == "MemAvailable:" {print int($2 / 1024)}' /proc/meminfo 2>/dev/null || true)
  free=${free:-0}
  while read -r folder; do
    read -r limit used <<<"$(numbers_in "$folder" memory.max memory.current)"
    [[ -n $used ]] || read -r limit used <<<"$(numbers_in "$folder" memory.limit_in_bytes memory.usage_in_bytes)"
    [[ -n $used ]] || continue
    limit=$(((limit - used) / 1048576))
    ((limit >= free)) || free=$limit
  done < <(groups_of memory)
  echo "$((free > 0 ? free : 0))"
}
free_disk_mb() { df -Pk . | awk 'NR == 2 {print int($4 / 1024)}'; }

# jobs_for MB: how many processes of so many megabytes fit, at most one per core.
jobs_for() {
  local jobs fit
  jobs=$(cores)
  fit=$(($(free_memory_mb) / $1))
  ((fit >= jobs)) || jobs=$fit
  ((jobs >= 1)) || jobs=1
  echo "$jobs"
}

# check_room MEMORY_MB DISK_MB: warns if there is less.
check_room() {
  local memory disk
  memory=$(free_memory_mb)
  disk=$(free_disk_mb)
  say "free here: $memory MB of memory, $disk MB of disk, $(cores) cores"
  ((memory >= $1)) || warn "only $memory MB of memory are free, $1 MB are wanted: it may be killed or very slow"
  ((disk >= $2)) || warn "only $disk MB of disk are free, $2 MB are wanted: it may stop for lack of room"
}
