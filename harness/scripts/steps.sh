# shellcheck shell=bash
# What run_all.sh and run_tests.sh share: messages, steps that can be interrupted, sizes of the machine.
# To be sourced by a script that has set `script` to its name.
# shellcheck disable=SC2154

child= # process of the step that is running
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

# on_signal STATUS: ends the running step, then the script. A second signal ends the script at once.
on_signal() {
  trap - INT TERM HUP
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

cores() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

# free_memory_mb, free_disk_mb: what is available here; a container's own memory limit counts.
free_memory_mb() {
  local free limit used
  free=$(awk '$1 == "MemAvailable:" {print int($2 / 1024)}' /proc/meminfo 2>/dev/null || true)
  free=${free:-0}
  if read -r limit 2>/dev/null </sys/fs/cgroup/memory.max && [[ $limit =~ ^[0-9]+$ ]] &&
    read -r used 2>/dev/null </sys/fs/cgroup/memory.current; then
    limit=$(((limit - used) / 1048576))
    ((limit >= free)) || free=$limit
  fi
  echo "$free"
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
