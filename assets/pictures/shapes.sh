#!/bin/sh
# Makes the row of pictures in the README: the dragon at rest, coiled, and halfway in between, linear
# and in log space. shapes.sh [VIETE]
set -eu
. "$(dirname "$0")/common.sh"

picture() {  # NAME DISTANCE OPTION...: the smaller a model, the farther its camera, so that all are about as large
  name=$1
  printf '{"format": "viete session", "version": 1, "model": "%s.ply", "view": {"panels": false},
    "camera": {"target": [0, 0, 0], "distance": %s, "yaw": 0.1, "pitch": 0.25}}' "$1" "$2" > "$scratch/$name.viete"
  shift 2
  "$viete" between "$dragon/dragon.ply" "$dragon/shape_coiled.pc2" "$@" -o "$scratch/$name.ply" 2>/dev/null
  "$viete" render "$scratch/$name.viete" --size 320x270 --no-grid --force -o "$here/shape_$name.png" 2>/dev/null
}

picture rest 2.4 --at 0
picture linear 3.3 --at 0.5 --linear
picture log 2.5 --at 0.5
picture coiled 2.8 --at 1
