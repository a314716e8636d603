#!/bin/sh
# Installs dependencies, builds and runs the program on Debian or Ubuntu; see usage() below.
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$(readlink -f -- "$0")")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: third_party/setup.sh [COMMAND] [ARGS...]
  run [ARGS...]         install dependencies, build the program, start it (default)
  test [CTEST ARGS...]  install dependencies, build program and tests, run the tests (-L long: the overnight tests)
  build                 install dependencies, build the program: build/viete
  bench [ARGS...]       install dependencies, build and run the benchmarks: build/viete bench
  package               build Debian packages of the program and the library: build-package/*.deb
  portable              build a folder for any Linux: build-portable/*.tar.xz
  wheel                 build a wheel of the Python module for any Linux: build-wheel/*.whl
  windows               cross-compile the program for Windows: build-windows/*.zip
  deps [COMMAND]        only install dependencies of the program (and of the other commands)
  help                  show this help
The first run builds kernels for this processor only, which is faster; packages and tests have all kernels.
JOBS=2 limits the number of parallel compilers.
TEXT
}

# Required to build and run the program.
program="g++ cmake ninja-build pkg-config libglfw3-dev libglm-dev libeigen3-dev libhwy-dev libimgui-dev libopenmesh-dev
libstb-dev libcli11-dev nlohmann-json3-dev zlib1g-dev libegl-dev libgl-dev libegl1 libgl1 libgl1-mesa-dri"
# Optional: FBX and other formats, compressed glTF, HTML manual, names in all scripts, fonts, drawing without a display (Mesa 25.1 dropped OSMesa in favour of EGL), title bars on Wayland.
program_wish="libassimp-dev libdraco-dev libmeshoptimizer-dev cmark-gfm libfontconfig-dev fonts-inter fonts-jetbrains-mono libosmesa6 libdecor-0-plugin-1-cairo"
tests="doctest-dev libtinygltf-dev pybind11-dev python3-dev python3-numpy"
# Optional for tests: a virtual display with a mouse, and package inspection.
tests_wish="xvfb xdotool dpkg-dev file mypy desktop-file-utils"
# Finds the library dependencies of packages; unpacks sources and packs wheels.
packing="dpkg-dev file"
# Static libraries and headers of viete-import in packages.
packed="libdraco-dev libminizip-dev libutfcpp-dev"
windows="g++ cmake ninja-build pkg-config g++-mingw-w64-x86-64-posix dpkg-dev libgl-dev libegl-dev librsvg2-bin icoutils libutfcpp-dev"
wheel="$packing pybind11-dev python3-dev python3-numpy python3-wheel"

say() { echo "setup.sh: $*" >&2; }

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]; }

# Prints the packages that are not installed.
missing_of() {
  for p in "$@"; do installed "$p" || printf '%s ' "$p"; done
}

# percent WHAT N: shows progress on one line of a terminal, otherwise a line every 10 %.
percent() {
  what=$1
  if [ $terminal = 1 ]; then
    [ "$2" -le "$shown" ] || { printf '\r  %s %d %%' "$1" "$2" >&2; shown=$2; }
  elif [ "$2" -ge $((shown + 10)) ]; then
    shown=$(($2 - $2 % 10))
    printf '  %s %d %%\n' "$1" "$shown" >&2
  fi
}

end_of_line() {
  if [ $terminal = 1 ] && [ "$shown" -gt 0 ]; then echo >&2; fi
}

# Shows the progress of apt-get status lines: "dlstatus:1:37.5:..." and "pmstatus:package:62.0:...".
installing() {
  shown=0 what=""
  while IFS=: read -r kind _ part _; do
    case "$kind" in
      dlstatus) percent fetching "${part%%.*}" ;;
      pmstatus) [ "$what" = installing ] || { end_of_line; shown=0; }; percent installing "${part%%.*}" ;;
    esac
  done
  end_of_line
}

# Runs apt-get; waits while another package manager has the lock. Shows its output only if it fails.
apt() {
  tries=0
  while :; do
    rm -f "$work/done"
    # Status lines use descriptor 3, opened after sudo, which closes descriptors; dpkg does not pass it to its scripts.
    { $root env LC_ALL=C DEBIAN_FRONTEND=noninteractive sh -c 'exec apt-get -q -o APT::Status-Fd=3 "$@" 3>&1' apt "$@" 2>&1 &&
      : >"$work/done"; } | tee "$work/apt.log" | installing
    ! grep -q 'Could not resolve\|Temporary failure resolving\|Could not connect\|Unable to connect\|Network is unreachable\|Failed to fetch' \
      "$work/apt.log" || unreachable=1
    [ ! -e "$work/done" ] || return 0
    if ! grep -q 'Could not get lock\|Unable to lock' "$work/apt.log" || [ $tries -ge 120 ]; then
      grep -v '^dlstatus\|^pmstatus' "$work/apt.log" >&2
      return 1
    fi
    [ $tries -gt 0 ] || say "waiting for another package manager to finish"
    tries=$((tries + 1))
    sleep 5
  done
}

# Reports required packages that could not be installed.
not_installed() {
  if [ -n "$unreachable" ]; then
    say "the package servers cannot be reached: connect to the network and run this again, or install manually: ${missing% }"
  else
    say "these packages could not be installed (see above): ${missing% }"
  fi
  return 1
}

# deps program|test|package|portable|wheel|windows: installs missing packages; missing optional packages are not an error.
deps() {
  need=$program wish=$program_wish unreachable=""
  case "$1" in
    test) need="$need $tests" wish="$wish $tests_wish" ;;
    package) need="$need $packing $packed" ;;
    portable) need="$need $packing $packed xz-utils" ;;
    wheel) need="$need $wheel" ;;
    windows) need=$windows wish="cmark-gfm fonts-inter fonts-jetbrains-mono" ;;
  esac
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "apt-get not found; install the equivalents of:" $need "and, if available:" $wish
    return 0
  fi
  missing=$(missing_of $need) wished=$(missing_of $wish)
  # Remembers optional packages that are unavailable; only `deps` tries them again.
  stamp=$here/.cache/packages-not-to-be-had
  unknown=""
  [ "$verb" = deps ] || unknown=$(cat "$stamp" 2>/dev/null || true)
  for p in $wished; do
    case " $unknown " in *" $p "*) ;; *) asked=1 ;; esac
  done
  if [ -z "$missing" ] && [ -z "${asked:-}" ]; then return 0; fi
  root="" refused="" left=""
  if [ "$(id -u)" != 0 ]; then
    root=sudo
    if ! command -v sudo >/dev/null; then
      refused="sudo is not installed"
    elif ! sudo sh -c :; then
      refused="sudo has refused"
    fi
  fi
  if [ -n "$refused" ] && [ -n "$missing" ]; then
    say "these packages are missing: ${missing% }"
    say "$refused; install them as root: su -c '$here/third_party/setup.sh deps $1'"
    return 1
  fi
  if [ -n "$refused" ]; then
    left=" $wished"
  elif say "updating the package lists" && apt update; then
    if [ -n "$missing" ] && ! fetch $missing; then not_installed; return 1; fi
    found=""
    for p in $wished; do
      if apt-cache show "$p" >/dev/null 2>&1; then found="$found $p"; else left="$left $p"; fi
    done
    if [ -n "$found" ] && ! fetch $found; then left="$left$found"; fi
  else
    if [ -n "$missing" ]; then not_installed; return 1; fi
    left=" $wished"
  fi
  if [ -n "$left" ]; then say "not installed, and not needed:${left% }"; fi
  mkdir -p "$here/.cache"
  echo $left >"$stamp"
}

# Shows the download size, then installs.
fetch() {
  LC_ALL=C apt-get -s --print-uris install --no-install-recommends "$@" 2>/dev/null |
    sed -n 's/^0 upgraded, \([0-9]* newly installed\).*/  \1/p; s/^\(Need to get\|After this operation\)/  &/p' |
    awk '!said[$0]++' >&2
  apt -y install --no-install-recommends "$@"
}

# Serialises runs that share a build folder. The lock of a killed run is ignored.
lock() {
  lock=$here/.cache/setup.lock said=""
  mkdir -p "$here/.cache" 2>/dev/null || return 0
  until ln -s $$ "$lock" 2>/dev/null; do
    owner=$(readlink "$lock") || { [ -w "$here/.cache" ] && continue || return 0; }
    if ! grep -q setup "/proc/$owner/cmdline" 2>/dev/null; then
      [ "$(readlink "$lock" || true)" != "$owner" ] || rm -f "$lock"
      continue
    fi
    [ -n "$said" ] || say "another setup.sh (process $owner) is building here: waiting for it to finish"
    said=1
    sleep 2
  done
  locked=1
}

# build TARGET FOLDER CMAKE-OPTIONS...: configures the folder if needed, or if the target is not the program.
build() {
  target=$1 folder=$here/$2
  shift 2
  if [ -e "$folder" ] && [ ! -w "$folder" ]; then
    say "$folder belongs to $(stat -c %U "$folder"); remove it, or change its owner: sudo chown -R $(id -un) '$folder' '$here/.cache'"
    return 1
  fi
  lock
  mkdir -p "$folder"
  if [ ! -e "$folder/build.ninja" ] || [ "${target#viete}" = "$target" ]; then
    if ! cmake -S "$here" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >"$folder/configure.log" 2>&1; then
      cat "$folder/configure.log" >&2
      say "configuration failed; the output above is in $folder/configure.log"
      return 1
    fi
  fi
  rm -f "$work/done"
  { cmake --build "$folder" --target "$target" -j "${JOBS:-$(nproc)}" 2>&1 && : >"$work/done"; } | compiling
  [ -e "$work/done" ]
}

# Turns ninja's "[3/80] Building ..." into progress; passes other output on.
compiling() {
  shown=0
  while IFS= read -r line; do
    case "$line" in
      \[[0-9]*/[0-9]*\]*)
        step=${line#?}
        step=${step%%\]*}
        if [ "${step#*/}" -gt 3 ]; then percent building $((100 * ${step%/*} / ${step#*/})); fi
        ;;
      "-- "* | "ninja: no work to do.") ;;
      *)
        end_of_line
        shown=0
        printf '%s\n' "$line" >&2
        ;;
    esac
  done
  end_of_line
}

# After a build as root, gives new files to the owner of the folder.
give_back() {
  [ "$(id -u)" = 0 ] || return 0
  owner=$(stat -c %u:%g "$here")
  for made in "$here/build" "$here/build-package" "$here/build-portable" "$here/build-wheel" "$here/build-windows" "$here/.cache"; do
    if [ -e "$made" ] && [ "$(stat -c %u:%g "$made")" != "$owner" ]; then chown -R "$owner" "$made"; fi
  done
}

build_program() {
  if [ ! -e "$here/build/viete" ]; then say "building the program: three to five minutes on two cores"; fi
  build "$1" build -DVIETE_BUILD_TESTS=OFF -DVIETE_BUILD_PYTHON=OFF -DVIETE_KERNELS=native
}

build_tests() {
  say "building the program and its tests"
  build all build -DVIETE_BUILD_TESTS=ON -UVIETE_BUILD_PYTHON -DVIETE_KERNELS=all -DVIETE_WERROR=ON
  compile_times "$here/build/.ninja_log"
}

# Compile time of each source folder in seconds, from ninja's log; the last line of an object counts.
compile_times() {
  [ -e "$1" ] || return 0
  awk -F '\t' '$4 ~ /^src\/.*\.o$/ { seconds[$4] = ($2 - $1) / 1000 }
    END {
      for (object in seconds) {
        room = substr(object, 5)
        sub("/CMakeFiles/.*", "", room)
        sum[room] += seconds[object]
      }
      for (room in sum) printf "%.0f %s\n", sum[room], room
    }' "$1" | sort -nr | awk '{ text = text ", " $2 " " $1 " s" } END { print "setup.sh: compiling took: " substr(text, 3) }' >&2
}

# Puts the tests' many small files into memory if there is enough, because the disk is slow.
files_in_memory() {
  if [ -n "${TMPDIR:-}" ] || [ ! -w /dev/shm ]; then return 0; fi
  free=$(df -Pk /dev/shm 2>/dev/null | awk 'NR == 2 { print $4 }')
  if [ "${free:-0}" -gt 2000000 ]; then export TMPDIR=/dev/shm; fi
}

clean_up() {
  [ -z "$locked" ] || rm -f "$lock"
  locked=""
  rm -rf "$work"
  give_back
}

terminal=0 locked=""
[ ! -t 2 ] || terminal=1
verb="${1:-run}"
[ $# -eq 0 ] || shift
case "$verb" in
  run | bench | test | build | package | portable | wheel | windows | deps) ;;
  help | -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac
work=$(mktemp -d)
trap clean_up EXIT
trap 'exit 130' INT TERM HUP
case "$verb" in
  deps)
    case "${1:-program}" in
      program | test | package | portable | wheel | windows) deps "${1:-program}" ;;
      *) usage >&2; exit 2 ;;
    esac
    exit 0
    ;;
  build | run) deps program; build_program viete ;;
  bench) deps program; build_program viete-bench ;;
  test) deps test; build_tests ;;
  package | portable | wheel)
    deps "$verb"
    . "$here/third_party/portable.sh"
    "build_$verb"
    ;;
  windows) deps windows; sh "$here/third_party/windows.sh" "$here/build-windows" ;;
esac
clean_up
trap - EXIT
case "$verb" in
  run) exec "$here/build/viete" "$@" ;;
  bench) exec "$here/build/viete" bench "$@" ;;
  test)
    files_in_memory
    [ $# -gt 0 ] || set -- -LE long
    exec ctest --test-dir "$here/build" --output-on-failure -j "${JOBS:-$(nproc)}" "$@"
    ;;
esac
