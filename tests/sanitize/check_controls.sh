#!/bin/sh
# The sanitizers of the preset asan find what is planted: check_controls.sh SOURCES FOLDER
set -eu
sources=$1 folder=$2
flags=$(sed -n 's/.*"CMAKE_CXX_FLAGS_ASAN": "\([^"]*\)".*/\1/p' "$sources/../../CMakePresets.json")
[ -n "$flags" ] || { echo "the preset asan has no CMAKE_CXX_FLAGS_ASAN"; exit 1; }
mkdir -p "$folder"
cd "$folder"
for control in overflow:AddressSanitizer undefined:"runtime error"; do
  name=${control%%:*} says=${control#*:}
  # shellcheck disable=SC2086  # the flags are words
  "${CXX:-c++}" -std=c++20 $flags "$sources/$name.cpp" -o "$name"
  if ./"$name" >"$name.log" 2>&1; then
    echo "$name was not stopped"
    exit 1
  fi
  grep -q "$says" "$name.log" || { cat "$name.log"; exit 1; }
done
echo "both planted faults were found"
