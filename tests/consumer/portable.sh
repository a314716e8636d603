#!/bin/sh
# portable.sh SOURCES VIETE VERSION: makes the portable folder. The archive must be small and complete, its programs must
# need few libraries, and they must run from any folder and deform as VIETE does. Skipped without Debian's tools.
set -eu
sources="$1" viete="$2" version="$3"
for tool in apt-get readelf xz; do command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }; done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

wrong() {
  echo "$*" >&2
  exit 1
}

"$sources/third_party/setup.sh" portable >"$work/log" 2>&1 || { cat "$work/log"; wrong "setup.sh portable fails"; }
archive="$sources/build-portable/viete-$version-linux-$(uname -m).tar.xz"
others=$(tar -tf "$archive" | grep -v "^viete-$version/" || true)
[ -z "$others" ] || wrong "$archive has other folders: $others"

mkdir "$work/any where"
tar -xf "$archive" -C "$work/any where"
here="$work/any where/viete-$version"
size=$(tar -cC "$here" --exclude='*.png' --exclude='*.webp' . | xz -6e | wc -c)
[ "$size" -le 12000000 ] || wrong "$archive has more than 12 MB without pictures: $size bytes"
[ "$(stat -c %s "$archive")" -le 14000000 ] || wrong "$archive is larger than 14 MB"
for file in CHANGELOG.md share/viete/dragon/dragon.ply share/viete/manual/index.html share/licences/viete.txt \
  share/licences/libopenmesh-dev.txt share/licences/assimp.txt share/licences/libdraco-dev.txt share/licences/meshoptimizer.txt; do
  test -s "$here/$file" || wrong "$archive has no $file"
done

# needs FILE LIBRARIES: fails if the file needs other libraries.
needs() {
  readelf -d "$here/$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -v -x -E "lib(c|m)\.so\.6|libdl\.so\.2|libpthread\.so\.0|ld-linux.*|$2" &&
    wrong "$1 needs these libraries"
  return 0
}
needs viete 'libglfw\.so\.3|libz\.so\.1'
needs viete-bench 'libz\.so\.1'
needs viete-import 'libz\.so\.1'
needs lib/libglfw.so.3 'libX11\.so\.6'
readelf -d "$here/viete" | grep -q 'R.*PATH.*\[$ORIGIN/lib\]' || wrong "viete does not look for libraries in lib"

cd /
unset VIETE_ASSETS
"$here/viete" --version | grep -q "^viete $version\$"
"$here/viete" info | grep -q -F "$here/share/viete/dragon/dragon.ply"
dragon="$here/share/viete/dragon"
deform() { "$1" deform "$dragon/dragon.ply" "$dragon/cage.obj" --pose "$dragon/pose_alert.obj" -o "$2"; }
deform "$viete" "$work/expected.ply"
deform "$here/viete" "$work/posed.ply"
cmp "$work/expected.ply" "$work/posed.ply"
"$here/viete" render "$dragon/dragon.ply" "$dragon/cage.obj" --size 320x200 -o "$work/picture.png"
test -s "$work/picture.png"
for file in smile.fbx packed.gltf meshopt.gltf; do
  env -u VIETE_IMPORT "$here/viete" info "$sources/tests/foreign/$file" | grep -q 'vertices  *[1-9]' || wrong "$file cannot be read"
done
"$here/viete" bench exp --count 1000 | grep -q Fast
