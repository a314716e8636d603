#!/bin/sh
# Makes the moving picture at the head of the README: a vertex of the dragon's cage is dragged, the head turns, and the
# body coils. motion.sh [VIETE]. Needs img2webp (package webp) and convert (package imagemagick).
set -eu
. "$(dirname "$0")/common.sh"
width=640 height=420
vertex=62  # the cage vertex that is dragged, at the wrist of a wing

# Prints the vertices of an OBJ file as JSON.
points() { awk '$1 == "v" { printf "%s[%s, %s, %s]", n++ ? ", " : "[", $2, $3, $4 } END { print "]" }' "$1"; }
# Prints a key: key FRAME CAGE [SHAPE].
key() { printf '%s{"frame": %s, "positions": %s%s}' "$comma" "$1" "$2" "${3:+, \"shape\": $3}" && comma=,; }
comma=
# Prints the cage at a frame of the dragon's loop.
loop() { sed -n "s/^ *{\"frame\": $1, .*\"positions\": \(.*\)},\{0,1\}$/\1/p" "$dragon/loop.viete"; }

rest=$(points "$dragon/cage.obj")

# Prints "X Y Z LEFT TOP" for a frame of the drag: the vertex and its pixel. There, the dragon's bounding box has its centre
# at `c` and the diagonal d; the camera is the one of the session below.
drag() {
  awk -v f="$1" -v w=$width -v h=$height 'BEGIN {
    t = f < 14 ? (f - 1) / 13 : f < 18 ? 1 : (27 - f) / 9
    s = 0.5 - 0.5 * cos(3.14159265 * t)
    x = 0.3338 - 0.45 * s; y = 1.4590 + 0.70 * s; z = 0.5708 + 0.45 * s
    d = 3.8784 / 2; yaw = 0.42; pitch = 0.2; a = (x + 0.3198) / d; b = (y - 0.8571) / d - 0.08; c = z / d
    depth = 2.75 - cos(pitch) * (a * sin(yaw) + c * cos(yaw)) - b * sin(pitch)
    right = a * cos(yaw) - c * sin(yaw)
    up = b * cos(pitch) - sin(pitch) * (a * sin(yaw) + c * cos(yaw))
    scale = h / 2 / (sin(0.275) / cos(0.275)) / depth
    print x, y, z, w / 2 + right * scale, h / 2 - up * scale
  }'
}
coiled=$(tail -c +33 "$dragon/shape_coiled.pc2" | base64 -w 0)  # one frame of float32 after the header

{
  printf '{"format": "viete session", "version": 1, "model": "%s", "cage": "%s", "view": {"panels": false},\n' \
    "$dragon/dragon.ply" "$dragon/cage.obj"
  printf '"camera": {"target": [0, 0.08, 0], "distance": 2.75, "yaw": 0.42, "pitch": 0.2},\n'
  printf '"shapes": [{"float32": "%s"}],\n"time": {"first": 1, "last": 140, "rate": 15, "frame": 1, "keys": [\n' "$coiled"
  for frame in $(seq 27); do
    key "$frame" "$(echo "$rest" | awk -v n=$vertex -v at="$(drag "$frame")" -F '\\], ' -v OFS='], ' '{
      split(at, p, " "); $(n + 1) = "[" p[1] ", " p[2] ", " p[3]; print }')"
  done
  key 30 "$rest"
  key 45 "$(loop 35)"
  key 70 "$(loop 57)"
  key 74 "$(loop 57)"
  key 88 "$rest"
  key 90 "$rest"
  key 116 "$rest" 0
  key 122 "$rest" 0
  key 140 "$rest"
  echo ']}}'
} >"$scratch/motion.viete"

frames() {  # FIRST-LAST OPTION...
  range=$1
  shift
  "$viete" animate "$scratch/motion.viete" --frames "$range" --size ${width}x$height --no-grid "$@" -o "$scratch/f_###.png" 2>/dev/null
}
frames 1-88 --show-cage
frames 89-140

# A ring around the dragged vertex, and a mouse pointer.
for frame in $(seq 27); do
  picture=$scratch/f_$(printf %03d "$frame").png
  drag "$frame" | while read -r _ _ _ left top; do
    convert "$picture" -fill none -stroke '#ffb454' -strokewidth 2.5 -draw "translate $left,$top circle 0,0 8,0" \
      -fill white -stroke black -strokewidth 1 -draw "translate $left,$top polygon 0,0 0,17 4,13 7,20 10,19 7,12 12,12" "$picture"
  done
done
img2webp -loop 0 -lossy -q 55 -m 4 -d 67 "$scratch"/f_*.png -o "$here/motion.webp" >/dev/null
