#!/bin/sh
# Fuzzes every reader, two at a time: run_fuzzers.sh FOLDER_OF_PROGRAMS CORPUS SECONDS WORK
# What one finds lies in WORK; libFuzzer says how to run it again. The corpus in the sources is read, not changed.
set -eu
programs=$1 corpus=$2 seconds=$3 work=$4
mkdir -p "$work"
export ASAN_OPTIONS=allocator_may_return_null=1
readers='rows plans profiles csv bi4'
fuzz() {
  mkdir -p "$work/$1"
  case $1 in csv | bi4) words=particles ;; *) words=json ;; esac
  "$programs/fuzz_$1" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1500 -max_len=16384 -print_final_stats=1 \
    -dict="$corpus/../$words.dict" -artifact_prefix="$work/$1-" "$work/$1" "$corpus/$1" >"$work/$1.log" 2>&1
}
status=0
finish() { for one in $waiting; do wait "$one" || status=1; done; waiting='' beside=0; }
waiting='' beside=0
for reader in $readers; do
  fuzz "$reader" & waiting="$waiting $!" beside=$((beside + 1))
  if [ $beside -eq 2 ]; then finish; fi
done
finish
for reader in $readers; do
  echo "$reader: $(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$reader.log") executions"
  [ $status -eq 0 ] || tail -n 40 "$work/$reader.log"
done
if "$programs/fuzz_planted" -max_total_time=20 -artifact_prefix="$work/planted-" >"$work/planted.log" 2>&1; then
  echo "the planted fault was not found"
  exit 1
fi
exit $status
