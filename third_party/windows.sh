#!/bin/sh
# Cross-compiles Viete for Windows: windows.sh FOLDER [tests]. Fetches the source packages of the dependencies through apt, builds
# them with their own build files in FOLDER/prefix, and makes FOLDER/viete-VERSION-win64.zip. `tests` also compiles unit tests.
# setup.sh calls this script after it has installed the compiler.
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$0")/.." && pwd)
mkdir -p "$1"
work=$(cd "$1" && pwd)
host=x86_64-w64-mingw32
jobs=${JOBS:-$(nproc)}

say() { echo "windows.sh: $*" >&2; }

toolchain="-DCMAKE_TOOLCHAIN_FILE=$here/third_party/cmake/windows.cmake -DVIETE_WINDOWS_PREFIX=$work/prefix"
. "$here/third_party/libraries.sh"

# makefile PACKAGE: writes the Makefile of packages that have no Makefile for MinGW.
makefile() {
  cd "$work/sources/$1/tree"
  case $1 in
    zlib) CHOST=$host CC=$host-gcc-posix ./configure --static ;;
    minizip) printf 'libminizip.a: ioapi.o iowin32.o unzip.o\n\t$(AR) rcs $@ $^\n' >Makefile ;;
  esac
}

# with_make PACKAGE LIBRARY HEADER-FOLDER VARIABLE...: builds a library by the package's own Makefile.
with_make() {
  package=$1 library=$2 headers=$prefix/include/$3
  shift 3
  [ ! -e "$prefix/built/$package" ] || return 0
  say "compiling $package"
  log "$package-sources" unpack "$package"
  log "$package-makefile" makefile "$package"
  log "$package-build" make -j "$jobs" -C "$work/sources/$package/tree" "lib$library.a" CC=$host-gcc-posix CXX=$host-g++-posix AR=$host-ar \
    PKG_CONFIG=true "$@"
  mkdir -p "$headers" "$prefix/lib/pkgconfig"
  cp "$work/sources/$package/tree"/*.h "$headers"
  cp "$work/sources/$package/tree/lib$library.a" "$prefix/lib"
  printf 'Name: %s\nDescription: %s\nVersion: %s\nLibs: -L%s -l%s\nCflags: -I%s\n' "$library" "$library" \
    "$(dpkg-parsechangelog -l "$work/sources/$package/tree/debian/changelog" -S Version | sed 's/[+~-].*//')" \
    "$prefix/lib" "$library" "$headers" >"$prefix/lib/pkgconfig/$library.pc"
  completed "$package"
}

dependencies() {
  with_cmake glm -DGLM_TEST_ENABLE=OFF -DGLM_BUILD_TESTS=OFF
  with_cmake eigen3 -DEIGEN_BUILD_DOC=OFF -DEIGEN_BUILD_TESTING=OFF
  with_cmake highway -DHWY_ENABLE_TESTS=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF
  with_cmake cli11 -DCLI11_BUILD_TESTS=OFF -DCLI11_BUILD_EXAMPLES=OFF
  with_cmake nlohmann-json3 -DJSON_BuildTests=OFF
  with_cmake doctest -DDOCTEST_WITH_TESTS=OFF
  with_cmake glfw3 -DGLFW_BUILD_DOCS=OFF -DGLFW_BUILD_TESTS=OFF -DGLFW_BUILD_EXAMPLES=OFF
  with_cmake openmesh -DBUILD_APPS=OFF -DOPENMESH_BUILD_UNIT_TESTS=OFF -DOPENMESH_DOCS=OFF
  with_make zlib z .
  with_make libstb stb stb CFLAGS=-O2 SRCS="stb_image.c stb_image_write.c stb_rect_pack_truetype.c"
  with_make imgui imgui imgui CXXFLAGS="-O2 -I$prefix/include" SRCS="imgui.cpp imgui_draw.cpp imgui_tables.cpp imgui_widgets.cpp"
  requires imgui stb
  cp -rL /usr/include/GL /usr/include/KHR /usr/include/utf8.h /usr/include/utf8 "$prefix/include"
  with_make minizip minizip minizip CFLAGS="-O2 -I$prefix/include"
  with_cmake draco
  meshoptimizer_and_assimp
}

# An icon of several sizes, from the picture of the desktop's menus.
icon() {
  for size in 16 32 48 256; do rsvg-convert -w $size -h $size "$here/assets/desktop/viete.svg" -o "$work/icon-$size.png"; done
  icotool -c -o "$work/viete.ico" "$work"/icon-*.png
}

compile() {
  log viete-configure cmake -S "$here" -B "$work/build/viete" -G Ninja $toolchain -DCMAKE_BUILD_TYPE=Release -DVIETE_BUILD_TESTS="$1" -DVIETE_BUILD_PYTHON=OFF \
    -DVIETE_KERNELS=all -DVIETE_WERROR=ON -DVIETE_ICON="$work/viete.ico" \
    -DCMAKE_INSTALL_BINDIR=. -DCMAKE_INSTALL_DATADIR=share -DCMAKE_INSTALL_DOCDIR=share/doc
  shift
  log viete-build cmake --build "$work/build/viete" -j "$jobs" --target "$@"
}

# The fonts of the window, and the licences of everything in the package.
add_fonts_and_licences() {
  for font in opentype/inter/Inter-Regular.otf opentype/inter/Inter-SemiBold.otf truetype/jetbrains-mono/JetBrainsMono-Regular.ttf; do
    [ ! -e "/usr/share/fonts/$font" ] || install -D -m 644 "/usr/share/fonts/$font" "$1/share/fonts/$font"
  done
  install -D -m 644 "$here/LICENSE" "$1/LICENSE.txt"
  for source in "$work"/sources/*; do
    install -D -m 644 "$source/tree/debian/copyright" "$1/share/licences/$(basename "$source").txt"
  done
  for package in fonts-inter fonts-jetbrains-mono libutfcpp-dev; do
    [ ! -e "/usr/share/doc/$package/copyright" ] || install -D -m 644 "/usr/share/doc/$package/copyright" "$1/share/licences/$package.txt"
  done
}

pack() {
  version=$(sed -n 's/^project(viete VERSION \([0-9.]*\).*/\1/p' "$here/CMakeLists.txt")
  name=viete-$version-win64
  rm -rf "${work:?}/$name"
  log viete-install cmake --install "$work/build/viete" --prefix "$work/$name" --component viewer --strip
  rm -rf "${work:?}/$name/share/doc"
  add_fonts_and_licences "$work/$name"
  (cd "$work" && cmake -E tar cf "$name.zip" --format=zip "$name")
  say "created $work/$name.zip"
}

dependencies
icon
say "building the program"
if [ "${2:-}" = tests ]; then
  compile ON viete viete-console test_base test_sym3 test_mesh test_deform test_files
else
  compile OFF viete viete-console viete-bench
  pack
fi
