#!/bin/sh
# Makes the two rows of pictures in the README: three moments between two keys of the dragon's loop,
# linear and in log space. time.sh [VIETE]
set -eu
. "$(dirname "$0")/common.sh"

near='"camera": {"target": [0.3, 0.2, 0.28], "distance": 2.2, "yaw": 0.6, "pitch": 0.2}, "view": {"panels": false}, '

picture() {  # NAME FRAME LINEAR
  sed -e "s|\"dragon.ply\"|\"$dragon/dragon.ply\"|" -e "s|\"cage.obj\"|\"$dragon/cage.obj\"|" -e "s|\"poses\": |$near&|" \
    -e "s|\"frame\": 1, \"repeat\"|\"frame\": $2, \"linear\": $3, \"repeat\"|" "$dragon/loop.viete" > "$scratch/at.viete"
  "$viete" render "$scratch/at.viete" --size 320x300 --no-grid --force -o "$here/time_$1.png" 2>/dev/null
}

for frame in 42 46 50; do
  picture "linear_$frame" $frame true
  picture "log_$frame" $frame false
done
