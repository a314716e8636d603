#!/bin/sh
# optimised.sh CMAKE GENERATOR COMPILER PROJECT BUILD: configures a project without a build type. Unless the
# flags set an optimisation level, the library must be optimised. The level of kernels is not tested.
set -eu
cmake="$1" generator="$2" compiler="$3" project="$4" build="$5"
unset CXXFLAGS CMAKE_BUILD_TYPE

# levels FLAGS: prints the last (effective) level of every library source that is not a kernel.
levels() {
  rm -rf "$build"
  "$cmake" -S "$project" -B "$build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$1" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
  grep '"command".*/src/sym3/' "$build/compile_commands.json" | sed 's/.* \(-O[0-3a-z]*\) .*/\1/' | grep -v -x -e -O3 | sort -u
}

expect() {
  found=$(levels "$1")
  [ "$found" = "$2" ] || { echo "with flags '$1': $found, not $2" >&2; exit 1; }
}

expect "-g" -O2
expect "-g -Os" -Os
