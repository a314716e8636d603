#!/bin/sh
# Makes the pictures of the manual's chapter on deformers: one pose of the dragon by each deformer. deformers.sh [VIETE]
set -eu
. "$(dirname "$0")/common.sh"

picture() {  # NAME OPTION...
  name=$1
  shift
  "$viete" render "$dragon/dragon.ply" "$dragon/cage.obj" --pose "$dragon/pose_flight.obj" "$@" \
    --look front --size 420x400 --no-grid --force -o "$here/deformer_$name.png" 2>/dev/null
}

picture mean_value --deformer mean-value
picture published --deformer paper
picture default
picture rigid --deformer rigid
picture arap --deformer arap
picture local --deformer local
