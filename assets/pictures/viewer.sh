#!/bin/sh
# Makes the picture of the window of the README: viewer.sh [VIETE]
set -eu
. "$(dirname "$0")/common.sh"
"$viete" render "$dragon/dragon.ply" "$dragon/cage.obj" --pose "$dragon/pose_alert.obj" \
  --show-cage --panels --size 1440x900 --force -o "$here/viewer.png" 2>/dev/null
