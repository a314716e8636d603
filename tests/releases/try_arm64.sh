#!/bin/sh
# Run this manually before a release. Compiles the matrix functions and the deformer for 64-bit ARM, and runs their tests and the C
# example with qemu. Unpacks ARM libraries into the folder.
#   apt-get install g++-aarch64-linux-gnu qemu-user-static mmdebstrap; tests/releases/try_arm64.sh [FOLDER]
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$(readlink -f -- "$0")")/../.." && pwd)
folder=${1:-${TMPDIR:-/tmp}/viete-arm64}
for tool in aarch64-linux-gnu-g++ qemu-aarch64-static mmdebstrap; do
  command -v $tool >/dev/null || { echo "try_arm64.sh: apt-get install g++-aarch64-linux-gnu qemu-user-static mmdebstrap" >&2; exit 1; }
done
mkdir -p "$folder"
root=$folder/root
if [ ! -e "$root/lib/ld-linux-aarch64.so.1" ]; then
  rm -rf "$root"
  mmdebstrap --variant=extract --architectures=arm64 --quiet --include="libc6-dev,libstdc++-$(aarch64-linux-gnu-g++ -dumpversion)-dev,
    libglfw3-dev,libglm-dev,libeigen3-dev,libhwy-dev,libimgui-dev,libopenmesh-dev,libstb-dev,libcli11-dev,nlohmann-json3-dev,zlib1g-dev,libegl-dev,
    libgl-dev,doctest-dev,libtinygltf-dev" "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root"
  cp -a "$root/lib/." "$root/usr/lib/" && rm -r "$root/lib" && ln -s usr/lib "$root/lib"
fi
cat >"$folder/arm64.cmake" <<END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_SYSROOT $root)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
END
export PKG_CONFIG_SYSROOT_DIR="$root" PKG_CONFIG_LIBDIR="$root/usr/lib/aarch64-linux-gnu/pkgconfig:$root/usr/share/pkgconfig"
cmake -S "$here" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$folder/arm64.cmake" \
  -DVIETE_BUILD_PYTHON=OFF -DVIETE_BUILD_TESTS=ON >"$folder/configure.log"
cmake --build "$folder/build" --target test_sym3 test_deform
run() { qemu-aarch64-static -L "$root" "$@"; }
run "$folder/build/tests/sym3/test_sym3"
run "$folder/build/tests/deform/test_deform"
aarch64-linux-gnu-g++ --sysroot="$root" -x c -std=c99 "$here/tests/consumer/c/example.c" -I"$folder/build/include" -x none \
  "$folder/build/src/sym3/libviete_sym3.a" -lstdc++ -lm -o "$folder/example"
run "$folder/example"
