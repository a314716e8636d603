# Sourced by setup.sh: Debian packages, the portable folder of the program, and the wheel of the Python module.
# All run on systems whose libc is as new as the one here. Make them on Debian 12.

# Each release of Debian has other versions of its shared libraries, and those in C++ need the shared library of C++, which must not be
# carried along: graphics drivers may need a newer one. Therefore libraries without a static one in Debian are compiled from their
# source packages, in .cache/libraries.
static_libraries() (
  work=$here/.cache/libraries toolchain="" jobs=${JOBS:-$(nproc)}
  . "$here/third_party/libraries.sh"
  log openmesh-sources unpack openmesh
  [ "$1" = viete_python ] || meshoptimizer_and_assimp
)

# static_build TARGET FOLDER CMAKE-OPTIONS...
static_build() {
  static_libraries "$1"
  build "$@" -DVIETE_BUILD_TESTS=OFF -DVIETE_KERNELS=all "-DCMAKE_PREFIX_PATH=$here/.cache/libraries/prefix" \
    "-DVIETE_OPENMESH_SOURCES=$here/.cache/libraries/sources/openmesh/tree"
}

# Fails if a file needs libraries other than libc, its parts, and these.
needs_only() {
  file=$1
  shift
  for needed in $(readelf -d "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
    case " $* libc.so.6 libm.so.6 libdl.so.2 libpthread.so.0 ld-linux-x86-64.so.2 ld-linux-aarch64.so.1 " in
      *" $needed "*) ;;
      *) say "$file needs $needed"; return 1 ;;
    esac
  done
}

# copy_licences FOLDER PACKAGE...: licences of the libraries in all archives, of the packages, and of the compiled source packages.
copy_licences() {
  folder_of_licences=$1
  shift
  mkdir -p "$folder_of_licences"
  cp "$here/LICENSE" "$folder_of_licences/viete.txt"
  for p in libopenmesh-dev libstb-dev libglm-dev libeigen3-dev libhwy-dev libcli11-dev nlohmann-json3-dev libgcc-s1 "$@"; do
    for notes in "/usr/share/doc/$p" "$here/.cache/libraries/sources/$p/tree/debian"; do
      [ ! -r "$notes/copyright" ] || cp "$notes/copyright" "$folder_of_licences/$p.txt"
    done
  done
}

version() { sed -n 's/^project(viete VERSION \([0-9.]*\).*/\1/p' "$here/CMakeLists.txt"; }

build_package() {
  say "building the packages"
  # Installs libraries to Debian's multiarch folder.
  static_build package build-package "-DCMAKE_INSTALL_LIBDIR=lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)"
  for made in "$here"/build-package/*.deb; do say "created $made"; done
}

build_portable() {
  say "building the portable folder"
  static_build all build-portable -DVIETE_BUILD_PYTHON=OFF -DCMAKE_INSTALL_BINDIR=. '-DCMAKE_INSTALL_RPATH=$ORIGIN/lib' \
    '-DCMAKE_EXE_LINKER_FLAGS=-static-libstdc++ -static-libgcc'
  version=$(version)
  folder=$work/viete-$version all=$work/installed
  cmake --install "$here/build-portable" --prefix "$all" --component viewer --strip >/dev/null
  mkdir -p "$folder/lib" "$folder/share/fonts/opentype/inter" "$folder/share/fonts/truetype/jetbrains-mono"
  cp "$all/viete" "$all/viete-bench" "$all/viete-import" "$here/CHANGELOG.md" "$folder"
  mv "$all/share/viete" "$all/share/icons" "$folder/share"
  cp -L "$(ldconfig -p | sed -n 's/.*libglfw\.so\.3 .*=> //p' | head -n 1)" "$folder/lib/libglfw.so.3"
  for font in opentype/inter/Inter-Regular.otf opentype/inter/Inter-SemiBold.otf truetype/jetbrains-mono/JetBrainsMono-Regular.ttf; do
    [ ! -r "/usr/share/fonts/$font" ] || cp "/usr/share/fonts/$font" "$folder/share/fonts/$font"
  done
  copy_licences "$folder/share/licences" libglfw3-dev libimgui-dev fonts-inter fonts-jetbrains-mono \
    assimp meshoptimizer libdraco-dev libminizip-dev libutfcpp-dev
  needs_only "$folder/viete" libglfw.so.3 libz.so.1
  needs_only "$folder/viete-bench" libz.so.1
  needs_only "$folder/viete-import" libz.so.1
  needs_only "$folder/lib/libglfw.so.3" libX11.so.6
  made=$here/build-portable/viete-$version-linux-$(uname -m).tar.xz
  XZ_OPT=-6e tar -C "$work" --owner=root:0 --group=root:0 --sort=name -cJf "$made" "viete-$version"
  say "created $made"
}

# A wheel is a zip archive of the module, the types and a folder with its description.
build_wheel() {
  say "building the wheel"
  static_build viete_python build-wheel -DVIETE_BUILD_PYTHON=ON
  set -- "$here"/build-wheel/python/viete.cpython-*.so
  module=$1
  needs_only "$module" libstdc++.so.6 libgcc_s.so.1 libz.so.1
  python=$(basename "$module" | sed 's/.*cpython-\([0-9]*\).*/cp\1/')
  libc=$(getconf GNU_LIBC_VERSION | sed 's/glibc //; s/\./_/')
  # Before 2.12, pybind11 reads arrays of numpy 1 only.
  numpy=numpy
  ! dpkg --compare-versions "$(dpkg-query -W -f '${Version}' pybind11-dev)" lt 2.12 || numpy='numpy<2'
  version=$(version)
  folder=$work/wheel about=$work/wheel/viete-$version.dist-info
  mkdir -p "$about"
  strip -o "$folder/$(basename "$module")" "$module"
  cp -r "$here/src/python/viete-stubs" "$folder"
  copy_licences "$about/licenses" pybind11-dev
  cat >"$about/WHEEL" <<TEXT
Wheel-Version: 1.0
Generator: setup.sh
Root-Is-Purelib: false
Tag: $python-$python-manylinux_${libc}_$(uname -m)
TEXT
  { cat <<TEXT; cat "$here/src/python/README.md"; } >"$about/METADATA"
Metadata-Version: 2.1
Name: viete
Version: $version
Summary: Deform meshes by cages, and functions of symmetric 3x3 matrices
License: MIT
Requires-Python: ==3.${python#cp3}.*
Requires-Dist: $numpy
Description-Content-Type: text/markdown

TEXT
  /usr/bin/python3 -m wheel pack --dest-dir "$here/build-wheel" "$folder" >/dev/null
  for made in "$here"/build-wheel/*.whl; do say "created $made"; done
}
