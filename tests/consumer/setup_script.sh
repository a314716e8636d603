#!/bin/sh
# setup_script.sh SETUP.SH: runs a copy of third_party/setup.sh. Stubs replace the programs that it calls, and
# log their arguments.
set -u
setup=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# fresh: makes a checkout in a folder with a blank in its name, and stubs for a machine with every package.
fresh() {
  rm -rf "${scratch:?}"/*
  mkdir -p "$scratch/check out/third_party" "$scratch/bin" "$scratch/elsewhere"
  cp "$setup" "${setup%/*}/portable.sh" "${setup%/*}/libraries.sh" "$scratch/check out/third_party"
  calls=$scratch/calls
  : >"$calls"
  stand_in dpkg-query 'echo installed'
  stand_in apt-get 'exit 0'
  stand_in apt-cache 'exit 0'
  stand_in cmake 'case "$1" in
    -S) : >"$4/build.ninja"; printf "0\t1600\t0\tsrc/base/CMakeFiles/a.o\t0\n" >"$4/.ninja_log" ;;
    --build) printf "[1/4] a\n[4/4] b\n"; printf "#!/bin/sh\npwd; echo \"\$@\"\n" >"$2/viete"; chmod +x "$2/viete" ;;
  esac'
  stand_in ctest 'exit 0'
  stand_in sleep 'exit 0'
  stand_in id 'case "$1" in -un) echo somebody ;; *) echo 1000 ;; esac'
  for tool in sh awk basename cat chmod chown cp dirname env grep ln mkdir mktemp nproc printf pwd readlink rm sed sort stat tee; do
    [ -e "$scratch/bin/$tool" ] || ln -s "$(command -v $tool)" "$scratch/bin/$tool"
  done
}

# stand_in NAME BODY: makes a stub with this name.
stand_in() {
  printf '#!/bin/sh\necho "%s $*" >>"%s"\n%s\n' "$1" "$calls" "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}

# lacks PACKAGES SUDO: makes a new machine without these packages. SUDO is the body of the stub for sudo.
lacks() {
  fresh
  stand_in dpkg-query "case \"\$*\" in $1) ;; *) echo installed ;; esac"
  [ -z "$2" ] || stand_in sudo "$2"
}

# run SCRIPT ARGS...: runs the script in $scratch/elsewhere. Sets $out to the output and $code to the exit status.
run() {
  out=$(cd "$scratch/elsewhere" && PATH=$scratch/bin CDPATH=$scratch:/ sh "$@" 2>&1)
  code=$?
}

expect() {
  what=$1
  shift
  if ! "$@"; then
    failures=$((failures + 1))
    printf 'NOT SO: %s\n  exit status %s, output:\n%s\n  calls:\n%s\n' "$what" "$code" "$out" "$(cat "$calls")"
  fi
}

says() { printf '%s' "$out" | grep -q -e "$1"; }
called() { grep -q -e "$1" "$calls"; }
no() { ! "$@"; }
ended_with() { [ "$code" -eq "$1" ]; }

script="$scratch/check out/third_party/setup.sh"

# gives CODE TEXT ARGS...: runs the script with ARGS. Fails unless the exit status is CODE and the output contains TEXT.
gives() {
  wanted=$1 text=$2
  shift 2
  run "$script" "$@"
  expect "$* exits with $wanted" ended_with "$wanted"
  expect "$* says $text" says "$text"
}

fresh
gives 0 '^usage' --help
run "$script" frobnicate
expect 'an unknown command exits with 2' ended_with 2
expect 'an unknown command builds nothing' no called '^cmake'

fresh
gives 0 "^$scratch/elsewhere$" run model.obj 'a cage.obj' # the working folder is kept
expect 'run passes arguments on' says '^model.obj a cage.obj$'
expect 'run builds only the program' called '--target viete'
expect 'run builds no tests' called 'VIETE_BUILD_TESTS=OFF'
expect 'run shows progress' says 'building 100 %'
expect 'run prints few lines' [ "$(printf '%s\n' "$out" | wc -l)" -lt 24 ]
: >"$calls"
run "$script" run
expect 'a second run does not configure again' no called 'cmake -S'

fresh
run "$script" bench exp --count 7
expect 'bench builds the benchmarks' called '--target viete-bench'
expect 'bench runs the benchmarks' says '^bench exp --count 7$'

fresh
ln -s "$script" "$scratch/setup-here"
run "$scratch/setup-here" build
expect 'a symbolic link builds the checkout' called "cmake -S $scratch/check out "

fresh
run "$script" test -L unit
expect 'test builds the tests' called 'VIETE_BUILD_TESTS=ON'
expect 'test builds all kernels' called 'VIETE_KERNELS=all'
expect 'test treats warnings as errors' called 'VIETE_WERROR=ON'
expect 'test reports compile times' says 'compiling took: base 2 s'
expect 'test passes arguments to ctest' called 'ctest .*-j [0-9]* -L unit'

run "$script" test
expect 'test excludes long tests by default' called 'ctest .*-j [0-9]* -LE long'

fresh
stand_in cmake 'echo "no compiler"; exit 1'
gives 1 'no compiler' build
expect 'a failed configuration leaves only the build folder' [ "$(cd "$scratch/check out" && echo *)" = 'build third_party' ]

fresh
stand_in cmake 'case "$1" in -S) : >"$4/build.ninja" ;; --build) echo "[1/9] a"; echo "a.cpp:1: error: no"; exit 1 ;; esac'
gives 1 'a.cpp:1: error: no' run

lacks '*fonts-inter*' ''
gives 0 'not needed: fonts-inter' build
lacks '*libglm-dev*' ''
gives 1 "su -c '$script deps program'" build

lacks '*libglm-dev*' 'exec "$@"'
stand_in apt-get 'case "$*" in
  *update*) tries=$(grep -c "apt-get.*update" "'"$calls"'"); [ $tries -gt 2 ] || { echo "E: Could not get lock /var/lib/apt/lists/lock"; exit 100; } ;;
  "-s "*) echo "Need to get 7 MB of archives." ;;
  *install*) echo "dlstatus:1:50.0:x"; echo "pmstatus:one:100.0:x" ;;
esac'
gives 0 'waiting for another package manager' build
expect 'packages are installed after waiting' called 'apt-get.* -y install .*libglm-dev'
expect 'the download size is shown' says 'Need to get 7 MB'
expect 'installation progress is shown' says 'installing 100 %'

lacks '*libglm-dev*' 'exec "$@"'
stand_in apt-get 'case "$*" in *install*) echo "E: no space"; exit 100 ;; esac'
gives 1 'E: no space' build
expect 'a failed installation builds nothing' no called '^cmake'

lacks '*fonts-inter*' 'echo "somebody is not in the sudoers file"; exit 1'
gives 0 'not needed: fonts-inter' build
: >"$calls"
run "$script" build
expect 'sudo is tried only once' no called '^sudo'

lacks '*libglm-dev* | *fonts-inter*' 'exec "$@"'
stand_in apt-get 'case "$*" in *" -y install "*fonts-inter*) echo "E: held broken packages"; exit 100 ;; esac'
run "$script" build
expect 'a failed optional package is no error' ended_with 0
expect 'required packages are installed nevertheless' called ' -y install .*libglm-dev'

lacks '*libglm-dev*' 'exec "$@"'
run "$script" deps
expect 'the size query does not install' [ "$(grep -c '^apt-get.* install' "$calls")" -eq 2 ]
expect 'the size query simulates' called 'apt-get -s .*install .*libglm-dev'
expect 'exactly one call installs' \
  [ "$(grep '^apt-get.* install' "$calls" | grep -v -c '^apt-get -s ')" -eq 1 ]

lacks '*libglm-dev*' 'echo "somebody is not in the sudoers file"; exit 1'
gives 1 'missing: libglm-dev' build
expect 'refused sudo gives the advice for root' says "sudo has refused.*su -c '$script deps program'"

lacks '*libglm-dev*' 'exec "$@"'
stand_in apt-get 'case "$*" in
  *update*) echo "W: Failed to fetch http://deb.debian.org/x  Temporary failure resolving" ;;
  *install*) echo "E: Unable to locate package libglm-dev"; exit 100 ;;
esac'
run "$script" build
expect 'no network exits with 1' ended_with 1
expect 'no network is reported in the last line' [ -n "$(printf '%s\n' "$out" | tail -n 1 | grep 'cannot be reached.*libglm-dev')" ]

fresh
stand_in cmake 'case "$1" in
  -S) : >"$4/build.ninja" ;;
  --build) mkdir "$2/busy" || echo "two at once"; i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done; rmdir "$2/busy" ;;
esac'
for tool in rmdir; do ln -s "$(command -v $tool)" "$scratch/bin/$tool"; done
(cd "$scratch/elsewhere" && PATH=$scratch/bin sh "$script" build >"$scratch/first" 2>&1) &
run "$script" build
wait $!
expect 'parallel runs succeed' [ "$code" -eq 0 ]
expect 'the first parallel run builds alone' no grep -q 'two at once' "$scratch/first"
expect 'the second parallel run builds alone' no says 'two at once'
ln -s 999999999 "$scratch/check out/.cache/setup.lock"
run "$script" build
expect 'the lock of a killed run is ignored' ended_with 0
expect 'the lock is removed' [ ! -L "$scratch/check out/.cache/setup.lock" ]
sh -c 'while :; do :; done # setup' &
busy=$!
ln -s $busy "$scratch/check out/.cache/setup.lock"
stand_in sleep "kill $busy"
gives 0 "process $busy" build

fresh
stand_in cmake 'case "$1" in -S) mkdir -p "$4"; : >"$4/build.ninja" ;; --build) : >"$2/viete_1_amd64.deb" ;; esac'
libraries="$scratch/check out/.cache/libraries"
mkdir -p "$libraries/sources/openmesh" "$libraries/prefix/built" "$libraries/prefix/lib/pkgconfig"
: >"$libraries/sources/openmesh/complete"
: >"$libraries/prefix/built/meshoptimizer"
: >"$libraries/prefix/lib/pkgconfig/assimp.pc"
stand_in dpkg-source 'mkdir tree'
gives 0 'created .*build-package/viete_1_amd64.deb' package
expect 'packages contain Assimp' called "cmake -S $libraries/sources/assimp/tree .*BUILD_SHARED_LIBS=OFF"
expect 'packages link static libraries' called "cmake -S .*CMAKE_PREFIX_PATH=$libraries/prefix"
expect 'packages do not need the library of OpenMesh' called "cmake -S .*VIETE_OPENMESH_SOURCES=$libraries/sources/openmesh/tree"
: >"$calls"
run "$script" package
expect 'libraries are compiled once' no called 'cmake -S .*assimp'
expect 'packages are built for any machine' called 'cmake -S .*build-package.*VIETE_KERNELS=all'

lacks '*python3-wheel* | *xz-utils*' 'exec "$@"'
run "$script" deps portable
expect 'portable needs xz' called ' -y install .*xz-utils'
expect 'portable needs no Python' no called ' -y install .*python3-wheel'
run "$script" deps wheel
expect 'wheel needs its packer' called ' -y install .*python3-wheel'

[ $failures -eq 0 ] && echo "setup.sh: all is as it should be"
exit $failures
