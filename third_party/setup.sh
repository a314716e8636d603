#!/bin/sh
# From a fresh Debian or Ubuntu to a running program, in one command.
#   setup.sh [run [ARGS...]]   install what is missing, build, open the viewer on the bundled model
#   setup.sh test [CTEST ARGS] the same up to the tests
#   setup.sh build             the same up to the program, build/viete
#   setup.sh deps              install what is missing, nothing else
set -eu
cd "$(dirname "$0")/.."

need="g++ cmake ninja-build pkg-config libglfw3-dev libglm-dev libeigen3-dev libhwy-dev libimgui-dev libopenmesh-dev
libstb-dev libcli11-dev nlohmann-json3-dev doctest-dev pybind11-dev python3-dev python3-numpy libegl-dev libgl-dev libegl1 libgl1 libgl1-mesa-dri
fonts-inter fonts-jetbrains-mono"
# Used where the distribution has them: offscreen rendering (gone from Mesa 25.1; EGL takes over), and a
# virtual display with a mouse for the tests of the real window.
want="libosmesa6 xvfb xdotool"

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]; }

deps() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "setup.sh: no apt-get here; install by hand the equivalents of: $need $want" >&2
    return 0
  fi
  missing="" optional=""
  for p in $need; do installed "$p" || missing="$missing $p"; done
  for p in $want; do installed "$p" || optional="$optional $p"; done
  stamp=.cache/optional-packages
  if [ -z "$missing" ] && { [ -z "$optional" ] || [ "$(cat $stamp 2>/dev/null)" = "$optional" ]; }; then return 0; fi
  root=""
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { echo "setup.sh: run as root once, or install:$missing$optional" >&2; return 1; }
    root=sudo
  fi
  $root apt-get update -qq
  for p in $optional; do
    if apt-cache show "$p" >/dev/null 2>&1; then missing="$missing $p"; fi
  done
  if [ -n "$missing" ]; then
    echo "setup.sh: installing$missing"
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
  fi
  # Remember what this release does not have, so that the next start asks no server.
  left=""
  for p in $want; do installed "$p" || left="$left $p"; done
  mkdir -p .cache && printf '%s' "$left" >$stamp
}

build() {
  cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release >build-configure.log 2>&1 ||
    { cat build-configure.log >&2; return 1; }
  rm -f build-configure.log
  cmake --build build -j "${JOBS:-$(nproc)}"
}

verb="${1:-run}"
[ $# -eq 0 ] || shift
case "$verb" in
  deps) deps ;;
  build) deps; build ;;
  run) deps; build; exec build/viete "$@" ;;
  test) deps; build; exec ctest --test-dir build --output-on-failure "$@" ;;
  *) echo "usage: third_party/setup.sh [run [ARGS...] | test [CTEST ARGS...] | build | deps]" >&2; exit 2 ;;
esac
