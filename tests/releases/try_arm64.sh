#!/bin/sh
# Before a release, by hand: the functions of matrices, compiled for 64-bit ARM and run by qemu, their tests and the example of C.
#   apt-get install g++-aarch64-linux-gnu qemu-user-static; tests/releases/try_arm64.sh [FOLDER]
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$(readlink -f -- "$0")")/../.." && pwd)
folder=${1:-${TMPDIR:-/tmp}/viete-arm64}
for tool in aarch64-linux-gnu-g++ qemu-aarch64-static; do
  command -v $tool >/dev/null || { echo "try_arm64.sh: apt-get install g++-aarch64-linux-gnu qemu-user-static" >&2; exit 1; }
done
mkdir -p "$folder"
cat >"$folder/arm64.cmake" <<'END'
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
END
cmake -S "$here" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$folder/arm64.cmake" \
  -DVIETE_BUILD_VIEWER=OFF -DVIETE_BUILD_PYTHON=OFF -DVIETE_BUILD_TESTS=ON >"$folder/configure.log"
cmake --build "$folder/build" --target test_sym3
run() { qemu-aarch64-static -L /usr/aarch64-linux-gnu "$@"; }
run "$folder/build/tests/sym3/test_sym3"
cmake --install "$folder/build" --prefix "$folder/installed" --component library >/dev/null
aarch64-linux-gnu-g++ -x c -std=c99 "$here/tests/consumer/c/example.c" -I"$folder/installed/include" -x none \
  "$folder/installed/lib/libviete_sym3.a" -lstdc++ -lm -o "$folder/example"
run "$folder/example"
