#!/bin/sh
# without_batches.sh CMAKE SOURCE FOLDER COMPILER: compiles every source alone. This fails if a source
# lacks an #include that another source of its batch has.
set -eu
"$1" -S "$2" -B "$3" -G Ninja -DCMAKE_CXX_COMPILER="$4" -DCMAKE_BUILD_TYPE=Debug -DVIETE_UNITY=OFF -DVIETE_KERNELS=native \
  -DVIETE_BUILD_TESTS=OFF >/dev/null
exec "$1" --build "$3"
