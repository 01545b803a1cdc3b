#!/bin/sh
# The sanitizers of the preset asan find what is planted: check_controls.sh SOURCES FOLDER
set -eu
sources=$1 folder=$2
presets=$sources/../../CMakePresets.json
flags=$(sed -n 's/.*"CMAKE_CXX_FLAGS_ASAN": "\([^"]*\)".*/\1/p' "$presets")
compiler=$(sed -n 's/.*"Asan", "CMAKE_CXX_COMPILER": "\([^"]*\)".*/\1/p' "$presets")
[ -n "$flags" ] && [ -n "$compiler" ] || { echo "the preset asan has no CMAKE_CXX_FLAGS_ASAN or no CMAKE_CXX_COMPILER"; exit 1; }
mkdir -p "$folder"
cd "$folder"
for control in overflow:AddressSanitizer undefined:"runtime error"; do
  name=${control%%:*} says=${control#*:}
  # shellcheck disable=SC2086  # the flags are words
  "$compiler" -std=c++20 $flags "$sources/$name.cpp" -o "$name"
  if ./"$name" >"$name.log" 2>&1; then
    echo "$name was not stopped"
    exit 1
  fi
  grep -q "$says" "$name.log" || { cat "$name.log"; exit 1; }
done
echo "both planted faults were found"
