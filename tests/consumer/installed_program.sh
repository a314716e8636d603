#!/bin/sh
# installed_program.sh PROGRAM ASSETS: moves the installed tree. The program must then find the example model, and draw it
# without other files.
set -eu
unset VIETE_ASSETS
"$1" info | grep -F "$2/dragon/dragon.ply"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
moved="$work/moved here"
mkdir "$moved"
cp -r "$(dirname "$(dirname "$1")")"/. "$moved"
cd /
"$moved/bin/viete" info | grep -F "$moved/share/viete/dragon/dragon.ply"
"$moved/bin/viete" render "$moved/share/viete/dragon/dragon.ply" "$moved/share/viete/dragon/cage.obj" \
  --pose "$moved/share/viete/dragon/pose_alert.obj" --size 320x200 -o "$moved/picture.png"
test -s "$moved/picture.png"
