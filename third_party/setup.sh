#!/bin/sh
# From a fresh Debian or Ubuntu to a running program, in one command; see usage() below.
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$(readlink -f -- "$0")")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: third_party/setup.sh [COMMAND] [ARGS...]
  run [ARGS...]         install what is missing, build the program, start it (this is what no command does)
  test [CTEST ARGS...]  install what is missing, build program and tests, run the tests (-L long: those for a night)
  build                 install what is missing, build the program: build/viete
  bench [ARGS...]       the same for the benchmarks: build/viete bench
  package               make packages of the program and the library for any machine: build-package/*.deb
  deps [test|package]   install what is missing for the program (or the tests, or packages too), nothing else
  help                  this text
The first run builds kernels for this machine's processor alone, which is quicker; test and package build all of them.
JOBS=2 bounds how many compilers run at once.
TEXT
}

# What the program cannot be built or drawn without.
program="g++ cmake ninja-build pkg-config libglfw3-dev libglm-dev libeigen3-dev libhwy-dev libimgui-dev libopenmesh-dev
libstb-dev libcli11-dev nlohmann-json3-dev libegl-dev libgl-dev libegl1 libgl1 libgl1-mesa-dri"
# Nicer with: the manual as pages, fonts, drawing without a display (gone from Mesa 25.1, where EGL takes over), title bars on Wayland.
program_wish="cmark-gfm fonts-inter fonts-jetbrains-mono libosmesa6 libdecor-0-plugin-1-cairo"
tests="doctest-dev libtinygltf-dev pybind11-dev python3-dev python3-numpy"
# A virtual display with a mouse, and what looks into packages.
tests_wish="xvfb xdotool dpkg-dev file mypy"
# What finds the libraries that a package needs.
packing="dpkg-dev file"

say() { echo "setup.sh: $*" >&2; }

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]; }

# Those of the packages that are not installed.
missing_of() {
  for p in "$@"; do installed "$p" || printf '%s ' "$p"; done
}

# So many percent of the work: on one line of a terminal, otherwise a line every tenth.
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

# apt-get's "dlstatus:1:37.5:..." and "pmstatus:package:62.0:...".
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

# apt-get, patient with another package manager that holds a lock; what it says is shown only if it fails.
apt() {
  tries=0
  while :; do
    rm -f "$work/done"
    # Status lines have a descriptor of their own, made behind sudo, which closes others: dpkg keeps it from its scripts.
    { $root env LC_ALL=C DEBIAN_FRONTEND=noninteractive sh -c 'exec apt-get -q -o APT::Status-Fd=3 "$@" 3>&1' apt "$@" 2>&1 &&
      : >"$work/done"; } | tee "$work/apt.log" | installing
    ! grep -q 'Could not resolve\|Temporary failure resolving\|Could not connect\|Unable to connect\|Network is unreachable\|Failed to fetch' \
      "$work/apt.log" || unreachable=1
    [ ! -e "$work/done" ] || return 0
    if ! grep -q 'Could not get lock\|Unable to lock' "$work/apt.log" || [ $tries -ge 120 ]; then
      grep -v '^dlstatus\|^pmstatus' "$work/apt.log" >&2
      return 1
    fi
    [ $tries -gt 0 ] || say "waiting for another package manager to end"
    tries=$((tries + 1))
    sleep 5
  done
}

# What is needed could not be installed.
not_installed() {
  if [ -n "$unreachable" ]; then
    say "the servers of packages cannot be reached from here: connect this machine to the network and call this again, or install by hand: ${missing% }"
  else
    say "these packages could not be installed (see above): ${missing% }"
  fi
  return 1
}

# deps PROGRAM-TEST-OR-PACKAGE: what is missing is installed; what is only wished for never stops anything.
deps() {
  need=$program wish=$program_wish unreachable=""
  case "$1" in
    test) need="$need $tests" wish="$wish $tests_wish" ;;
    package) need="$need $packing" ;;
  esac
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "no apt-get here; install by hand the equivalents of:" $need "and, where there are such:" $wish
    return 0
  fi
  missing=$(missing_of $need) wished=$(missing_of $wish)
  # What could not be had was found out before: no server is asked again, but by `deps`.
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
      refused="there is no sudo here"
    elif ! sudo sh -c :; then
      refused="sudo has refused"
    fi
  fi
  if [ -n "$refused" ] && [ -n "$missing" ]; then
    say "these packages are missing: ${missing% }"
    say "$refused; let root install them: su -c '$here/third_party/setup.sh deps $1'"
    return 1
  fi
  if [ -n "$refused" ]; then
    left=" $wished"
  elif say "asking for the newest list of packages" && apt update; then
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

# Says how much that is, and installs it.
fetch() {
  LC_ALL=C apt-get -s --print-uris install --no-install-recommends "$@" 2>/dev/null |
    sed -n 's/^0 upgraded, \([0-9]* newly installed\).*/  \1/p; s/^\(Need to get\|After this operation\)/  &/p' |
    awk '!said[$0]++' >&2
  apt -y install --no-install-recommends "$@"
}

# Two runs at once would build in one folder: the second one waits. Whoever was killed holds nothing.
lock() {
  lock=$here/.cache/setup.lock said=""
  mkdir -p "$here/.cache" 2>/dev/null || return 0
  until ln -s $$ "$lock" 2>/dev/null; do
    owner=$(readlink "$lock") || { [ -w "$here/.cache" ] && continue || return 0; }
    if ! grep -q setup "/proc/$owner/cmdline" 2>/dev/null; then
      [ "$(readlink "$lock" || true)" != "$owner" ] || rm -f "$lock"
      continue
    fi
    [ -n "$said" ] || say "another setup.sh (process $owner) is building here: waiting for it to end"
    said=1
    sleep 2
  done
  locked=1
}

# build TARGET FOLDER CMAKE-OPTIONS...: the options are for a folder that is not configured yet, or one that has another use.
build() {
  target=$1 folder=$here/$2
  shift 2
  if [ -e "$folder" ] && [ ! -w "$folder" ]; then
    say "$folder belongs to $(stat -c %U "$folder"); remove it, or give it to yourself: sudo chown -R $(id -un) '$folder' '$here/.cache'"
    return 1
  fi
  lock
  mkdir -p "$folder"
  if [ ! -e "$folder/build.ninja" ] || [ "${target#viete}" = "$target" ]; then
    if ! cmake -S "$here" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >"$folder/configure.log" 2>&1; then
      cat "$folder/configure.log" >&2
      say "configuring failed; the text above is in $folder/configure.log"
      return 1
    fi
  fi
  rm -f "$work/done"
  { cmake --build "$folder" --target "$target" -j "${JOBS:-$(nproc)}" 2>&1 && : >"$work/done"; } | compiling
  [ -e "$work/done" ]
}

# Ninja's "[3/80] Building ..." becomes how far it is; whatever else it says is passed on.
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

# Root may build in somebody's folder; what it leaves behind is theirs.
give_back() {
  [ "$(id -u)" = 0 ] || return 0
  owner=$(stat -c %u:%g "$here")
  for made in "$here/build" "$here/build-package" "$here/.cache"; do
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

# Seconds that compiling each room of the sources took, by the log of ninja, whose last line of an object counts.
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

build_package() {
  say "building the packages"
  # Libraries lie where Debian has those of this kind of machine.
  build package build-package -DVIETE_BUILD_TESTS=OFF -DVIETE_KERNELS=all \
    "-DCMAKE_INSTALL_LIBDIR=lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)"
  for made in "$here"/build-package/*.deb; do say "made $made"; done
}

# Tests write many small files that wait for the disk: those go into memory where there is enough of it.
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
  run | bench | test | build | package | deps) ;;
  help | -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac
work=$(mktemp -d)
trap clean_up EXIT
trap 'exit 130' INT TERM HUP
case "$verb" in
  deps)
    case "${1:-program}" in
      program | test | package) deps "${1:-program}" ;;
      *) usage >&2; exit 2 ;;
    esac
    exit 0
    ;;
  build | run) deps program; build_program viete ;;
  bench) deps program; build_program viete-bench ;;
  test) deps test; build_tests ;;
  package) deps package; build_package ;;
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
