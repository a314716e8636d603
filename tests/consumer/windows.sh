#!/bin/sh
# windows.sh SOURCES VIETE VERSION: makes the package for Windows and tries it with Wine: unit tests, pictures and files equal to
# VIETE's, and the window by mouse. Skipped without MinGW, Wine, Xvfb or xdotool. A full disk is tried only by root, who can mount it.
set -eu
sources="$1" viete="$2" version="$3"
for tool in apt-get x86_64-w64-mingw32-g++-posix wine Xvfb xdotool; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
work=$(mktemp -d)
export WINEPREFIX="$work/wine" WINEDEBUG=-all
display=""

clean_up() {
  wineserver -k 2>/dev/null || true
  ! mountpoint -q "$work/small disk" || umount "$work/small disk"
  [ -z "$display" ] || kill "$display" 2>/dev/null || true
  rm -rf "$work"
}
trap clean_up EXIT

wrong() {
  echo "$*" >&2
  exit 1
}

# until_true COMMAND...: waits at most a minute.
until_true() {
  for _ in $(seq 120); do
    ! "$@" >/dev/null 2>&1 || return 0
    sleep 0.5
  done
  wrong "waited in vain for: $*"
}

"$sources/third_party/setup.sh" windows >"$work/log" 2>&1 || { cat "$work/log"; wrong "setup.sh windows fails"; }
archive="$sources/build-windows/viete-$version-win64.zip"
built="$sources/build-windows/build/viete"
sh "$sources/third_party/windows.sh" "$sources/build-windows" tests >"$work/log" 2>&1 || { cat "$work/log"; wrong "tests do not compile"; }
for test in base sym3 mesh deform files; do
  # Wine creates no symbolic links, and codes of names are bytes elsewhere.
  (cd "$built/tests/$test" && wine "./test_$test.exe" --test-suite-exclude=if_present \
    --test-case-exclude='saving_overwrites_no_open_file*,a_session_names_its_files_relative*,names_of_files_come_back_to_the_byte*') \
    >"$work/log" 2>&1 || { cat "$work/log"; wrong "test_$test.exe fails"; }
done

place="$work/any where $(printf '\303\251 \351\276\231')"
name_in_unicode=$(printf '\303\251 \351\276\231 ') written=$(printf 'by windows \303\251.ply')
mkdir "$place"
(cd "$place" && cmake -E tar xf "$archive")
here="$place/viete-$version-win64"
for file in viete.exe viete.com viete-bench.exe viete-import.exe LICENSE.txt share/viete/dragon/dragon.ply share/viete/manual/index.html \
  share/licences/openmesh.txt share/licences/assimp.txt share/licences/draco.txt share/licences/meshoptimizer.txt; do
  test -s "$here/$file" || wrong "$archive has no $file"
done
for program in viete.exe viete-import.exe; do
  x86_64-w64-mingw32-objdump -p "$here/$program" | sed -n 's/.*DLL Name: //p' | tr A-Z a-z |
    grep -v -x -E 'advapi32.dll|gdi32.dll|imm32.dll|kernel32.dll|msvcrt.dll|shell32.dll|user32.dll|ucrtbase.dll|api-ms-.*' && wrong "$program needs these libraries"
done

Xvfb -displayfd 5 -screen 0 1280x800x24 5>"$work/display" >/dev/null 2>&1 &
display=$!
until_true test -s "$work/display"
DISPLAY=:$(cat "$work/display")
export DISPLAY
cd "$place"
cp "$here/share/viete/dragon/dragon.ply" "$here/share/viete/dragon/cage.obj" "$here/share/viete/dragon/pose_coil.obj" .
windows() { wine "$here/viete.com" "$@" 2>"$work/said"; }
windows --version | grep -q "^viete $version" || wrong "viete.com prints no version"
! windows info missing.obj || wrong "a missing file is no error"
grep -q "there is no such file" "$work/said" || wrong "a missing file is not named"
! windows deform dragon.ply cage.obj --pose pose_coil.obj -o dragon.ply || wrong "the open model was overwritten"
! windows deform dragon.ply cage.obj --pose pose_coil.obj -o con.ply || wrong "con.ply was written"
for deformer in smooth paper mean-value rigid arap local; do
  windows deform dragon.ply cage.obj --pose pose_coil.obj --deformer $deformer -o "$written" --force
  "$viete" deform dragon.ply cage.obj --pose pose_coil.obj --deformer $deformer -o "by linux.ply" --force 2>/dev/null
  cmp "$written" "by linux.ply" || wrong "$deformer gives other bytes"
done
for file in smile.fbx house.dae packed.gltf meshopt.gltf; do
  cp "$sources/tests/foreign/$file" "$name_in_unicode$file"
  windows info "$name_in_unicode$file" | tr -d '\r' >windows.txt
  "$viete" info "$name_in_unicode$file" >linux.txt
  grep -q 'vertices  *[1-9]' windows.txt || wrong "$file cannot be read: $(cat "$work/said")"
  diff windows.txt linux.txt || wrong "$file is another model on Windows"
done
windows cage "${name_in_unicode}packed.gltf" -o "packed cage.obj"
windows deform "${name_in_unicode}packed.gltf" "packed cage.obj" --pose "packed cage.obj" -o packed.glb
test -s packed.glb

# A full disk: the file keeps its bytes, and no part file stays.
small="$work/small disk"
mkdir "$small"
ln -s "$small" "$WINEPREFIX/dosdevices/s:"
if [ "$(id -u)" = 0 ] && mount -t tmpfs -o size=64k small "$small" 2>/dev/null; then
  echo old >"$small/old.ply"
  ! windows deform dragon.ply cage.obj --pose pose_coil.obj -o 's:\old.ply' --force || wrong "a full disk is no error"
  grep -q "free some disk space" "$work/said" || wrong "a full disk is reported by: $(cat "$work/said")"
  [ "$(ls "$small") $(cat "$small/old.ply")" = "old.ply old" ] || wrong "a full disk changes the file"
else
  echo "A full disk was not tried: mounting is not allowed."
fi

windows render dragon.ply cage.obj --pose pose_coil.obj --size 400x300 -o windows.png
"$viete" render dragon.ply cage.obj --pose pose_coil.obj --size 400x300 -o linux.png
# Wine draws with Linux's OpenGL driver: the pictures have the same bytes.
cmp windows.png linux.png || wrong "the picture differs"

# window FILE...: opens the window and waits until it is drawn. Without a window manager, it gets no keys by itself.
window() {
  wine "$here/viete.exe" "$@" >"$work/said" 2>&1 &
  until_true xdotool search --onlyvisible --name ' - Viete'
  sleep 10
  xdotool windowfocus "$(xdotool search --onlyvisible --name ' - Viete' | head -n 1)"
}
# drag X Y DX DY
drag() {
  xdotool mousemove "$1" "$2" sleep 0.5 mousedown 1 sleep 0.3 mousemove_relative -- $(($3 / 2)) $(($4 / 2)) sleep 0.3 \
    mousemove_relative -- $(($3 / 2)) $(($4 / 2)) sleep 0.3 mouseup 1 sleep 1
}
kept() { find "$WINEPREFIX/drive_c/users" -path '*AppData/Local/viete/recovery/*.viete' | grep -q .; }
before=$(cksum <dragon.ply)
window dragon.ply cage.obj
drag 760 205 60 -40  # a vertex of the cage, on a wing's tip
until_true kept
xdotool key ctrl+s sleep 2 key Return
until_true test -s dragon.viete
xdotool key ctrl+e sleep 2 key ctrl+a sleep 0.5 type dragon.ply
xdotool sleep 1 key Return sleep 1 key Return sleep 3
[ "$(cksum <dragon.ply)" = "$before" ] || wrong "the window overwrote the open model"
xdotool key Escape sleep 1
xdotool key ctrl+z sleep 3
until_true kept
wineserver -k  # kills the program
window dragon.viete
kept || wrong "a second start removes the edits of a killed program"
