#!/bin/sh
# compile_times.sh BUILD MOST: prints what compiling each room took in processor-seconds. Fails if those of the program take more than
# MOST times what compile_reference.cpp took in the same build (the median of several). Skipped where compilers were not timed, or a
# cache compiled instead.
set -eu
cd "$1"
objects=$(find src tests/rules -path '*/viete_*' -name '*.o' ! -path '*python*')
times=""
for object in $objects; do
  [ -e "$object.times" ] || { echo "skipped: $object was compiled without being timed"; exit 77; }
  times="$times $object.times"
done
# A shell's `times`: user and system, of itself and, in the second line, of the compiler.
LC_ALL=C awk -F '[ms ]+' -v most="$2" '
  FNR == 2 {
    room = FILENAME
    if (room ~ /compile_reference/) { references[++n] = 60 * ($1 + $3) + $2 + $4; next }
    sub("/CMakeFiles/.*", "", room)
    sub("^src/", "", room)
    seconds[room] += 60 * ($1 + $3) + $2 + $4
  }
  END {
    for (i = 2; i <= n; ++i)
      for (j = i; j > 1 && references[j] < references[j - 1]; --j) {
        t = references[j]; references[j] = references[j - 1]; references[j - 1] = t
      }
    reference = references[int((n + 1) / 2)]
    if (reference < 0.3) { print "skipped: the reference took " reference " s, as from a cache"; exit 77 }
    for (room in seconds) {
      printf "%8.1f  %s\n", seconds[room], room | "sort -nr"
      if (room != "bench") sum += seconds[room]
    }
    close("sort -nr")
    printf "%8.1f  all but bench: %.0f times the reference of %.2f s, of %d\n", sum, sum / reference, reference, most
    exit sum > most * reference
  }' $times
