#!/bin/sh
# package.sh CPACK BUILD FOLDER VERSION: cpack must make Debian packages with the right files and dependencies. Packages must
# not contain paths of the build. The unpacked program must run. Without packaging tools, the test is skipped.
set -eu
cpack="$1" build="$2" folder="$3" version="$4"
foreign=$(CDPATH='' cd -P -- "$(dirname -- "$0")/../foreign" && pwd)
for tool in dpkg-deb dpkg-shlibdeps file readelf; do
  command -v $tool >/dev/null || { echo "skipped: no $tool (apt-get install dpkg-dev file)"; exit 77; }
done

wrong() {
  echo "$*" >&2
  exit 1
}

rm -rf "$folder"
(cd "$build" && "$cpack" -G DEB -B "$folder") >"$build/packages.log" 2>&1 || { cat "$build/packages.log"; wrong "cpack fails"; }
rm "$build/packages.log"
machine=$(dpkg --print-architecture)
program="$folder/viete_${version}_$machine.deb" library="$folder/libviete-dev_${version}_$machine.deb"

# holds DEB FILE...: fails unless the package contains the files.
holds() {
  deb="$1" && shift
  list=$(dpkg-deb -c "$deb")
  for name in "$@"; do echo "$list" | grep -q " \./usr/$name\$" || wrong "$deb holds no $name"; done
  others=$(echo "$list" | grep -v ' root/root .* \./usr/' | grep -v ' \./$' || true)
  [ -z "$others" ] || wrong "$deb holds what is not root's or not below /usr: $others"
  open=$(echo "$list" | grep -v '^l' | grep -E '^(.....w|........w)' || true)
  [ -z "$open" ] || wrong "$deb holds what others may write: $open"
}

holds "$program" bin/viete bin/viete-bench share/viete/dragon/dragon.ply share/applications/viete.desktop share/metainfo/viete.metainfo.xml \
  share/icons/hicolor/scalable/apps/viete.svg share/mime/packages/viete.xml share/man/man1/viete.1.gz share/doc/viete/copyright \
  share/bash-completion/completions/viete share/zsh/vendor-completions/_viete share/fish/vendor_completions.d/viete.fish
holds "$library" include/viete/sym3/exp.h 'lib/.*libviete_sym3.a' 'lib/.*viete-config.cmake' 'lib/.*viete.pc' \
  share/doc/libviete-dev/copyright
! dpkg-deb -c "$library" | grep -q 'trigonometric.h$' || wrong "$library holds internal headers"
module="$folder/python3-viete_${version}_$machine.deb" addon="$folder/blender-viete_${version}_all.deb"
if [ -e "$module" ]; then
  holds "$module" 'lib/python3/dist-packages/viete\..*\.so' lib/python3/dist-packages/viete-stubs/__init__.pyi share/doc/python3-viete/copyright
  holds "$addon" share/blender/scripts/addons/viete_cage/__init__.py share/doc/blender-viete/copyright
  dpkg-deb -f "$module" Depends | grep -q 'python3-numpy' || wrong "$module does not depend on numpy"
  dpkg-deb -x "$module" "$folder/module"
  PYTHONPATH="$folder/module/usr/lib/python3/dist-packages" /usr/bin/python3 -c 'import viete; viete.Deformer' || wrong "$module cannot be imported"
fi
both=$(for deb in "$program" "$library"; do dpkg-deb -c "$deb"; done | grep -v '/$' | awk '{ print $6 }' | sort | uniq -d)
[ -z "$both" ] || wrong "both packages hold $both"

# If lintian is installed, runs it. (This build does not use multiarch library folders, but setup.sh does.)
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning --suppress-tags pkg-config-unavailable-for-cross-compilation "$folder"/*.deb ||
    wrong "lintian reports problems"
fi

depends=$(dpkg-deb -f "$program" Depends)
for needed in libc6 libstdc++6 libglfw3 libgl1 libegl1; do
  echo "$depends" | grep -q "\(^\|, \)$needed\>" || wrong "$program does not depend on $needed: $depends"
done
for field in Maintainer Section; do
  [ -n "$(dpkg-deb -f "$program" $field)" ] || wrong "$program has no $field"
done
dpkg-deb -f "$program" Description | head -n 1 | grep -q '^deform a mesh' || wrong "$program is described by other words"

unpacked="$folder/unpacked"
dpkg-deb -x "$program" "$unpacked"
! readelf -d "$unpacked/usr/bin/viete" | grep -E 'R(UN)?PATH' || wrong "$program looks for libraries where it was built"
"$unpacked/usr/bin/viete" --version | grep -q "^viete $version\$"
env -u VIETE_ASSETS "$unpacked/usr/bin/viete" info | grep -q -F "$unpacked/usr/share/viete/dragon/dragon.ply"
for file in smile.fbx packed.gltf meshopt.gltf; do
  [ ! -e "$build/viete-import" ] || env -u VIETE_IMPORT "$unpacked/usr/bin/viete" info "$foreign/$file" | grep -q 'vertices  *[1-9]' ||
    wrong "the program in $program cannot read $file"
done
