# Sourced by windows.sh and portable.sh: compiles libraries from Debian's source packages. Installs them as static libraries in
# $work/prefix. Variables of the caller: $here; $work, the folder; $toolchain, options of CMake; $jobs, the number of compilers; say().
prefix=$work/prefix

# log NAME COMMAND...: runs a command with its output in a file; shows the file if the command fails.
log() {
  step=$1
  shift
  mkdir -p "$work/logs"
  if ! "$@" >"$work/logs/$step" 2>&1; then
    cat "$work/logs/$step" >&2
    say "$step failed; the output above is in $work/logs/$step"
    return 1
  fi
}

# apt-get with the system's package servers, but for sources and with lists and cache in the work folder.
apt_sources() {
  apt-get -q -o APT::Sandbox::User=root -o Dir::Etc::SourceList="$work/apt/sources.list" -o Dir::Etc::SourceParts=- \
    -o Dir::State::Lists="$work/apt/lists" -o Dir::Cache="$work/apt/cache" "$@"
}

listed=""
list_sources() {
  [ -z "$listed" ] || return 0
  rm -rf "$work/apt"
  mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' >"$work/apt/sources.list"
  # Servers of other vendors may have no sources: only required packages must be found.
  apt_sources update || true
  listed=1
}

# unpack PACKAGE: fetches a source package to $work/sources/PACKAGE/tree. Debian's patches are applied, except OpenMesh's: they allow
# only shared libraries.
unpack() {
  [ ! -e "$work/sources/$1/complete" ] || return 0
  patches=""
  [ "$1" != openmesh ] || patches=--skip-patches
  rm -rf "$work/sources/$1"
  mkdir -p "$work/sources/$1" && cd "$work/sources/$1" && list_sources && apt_sources source --download-only "$1" &&
    dpkg-source $patches -x ./*.dsc tree && : >complete
}

# with_cmake PACKAGE OPTION...: builds and installs a package by its own CMakeLists.txt.
with_cmake() {
  package=$1
  shift
  [ ! -e "$prefix/built/$package" ] || return 0
  say "compiling $package"
  log "$package-sources" unpack "$package"
  log "$package-configure" cmake -S "$work/sources/$package/tree" -B "$work/build/$package" -G Ninja $toolchain \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
    -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DCMAKE_POSITION_INDEPENDENT_CODE=ON "$@"
  log "$package-build" cmake --build "$work/build/$package" --target install -j "$jobs"
  completed "$package"
}

completed() {
  mkdir -p "$prefix/built"
  : >"$prefix/built/$1"
}

# requires LIBRARY OTHER: programs that link the static library link the other one too.
requires() {
  grep -q '^Requires:' "$prefix/lib/pkgconfig/$1.pc" || echo "Requires: $2" >>"$prefix/lib/pkgconfig/$1.pc"
}

# Libraries of the program viete-import; Draco and minizip must be installed. Assimp only reads, and only formats that Viete does not read.
meshoptimizer_and_assimp() {
  with_cmake meshoptimizer
  set --
  for format in 3D ASSBIN BVH CSM GLTF OBJ OFF OGRE PLY Q3BSP RAW STL; do set -- "$@" -DASSIMP_BUILD_${format}_IMPORTER=OFF; done
  with_cmake assimp -DASSIMP_NO_EXPORT=ON -DASSIMP_BUILD_ASSIMP_TOOLS=OFF -DASSIMP_BUILD_TESTS=OFF \
    -DASSIMP_WARNINGS_AS_ERRORS=OFF -DASSIMP_IGNORE_GIT_HASH=ON "$@"
  requires assimp minizip
}
