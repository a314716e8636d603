#!/bin/sh
# Makes the picture of a capture: capture.sh [VIETE]. Needs build/assets/generate_dragon and ImageMagick.
set -eu
. "$(dirname "$0")/common.sh"
"$here/../../build/assets/generate_dragon" --splats "$scratch/dragon.ply"
picture() {
  "$viete" render "$scratch/dragon.ply" "$dragon/cage.obj" --size 640x460 -o "$scratch/$@"
}
picture rest.png
picture bent.png --pose "$dragon/pose_alert.obj" --show-cage
convert "$scratch/rest.png" "$scratch/bent.png" +append -quality 85 "$here/capture.webp"
