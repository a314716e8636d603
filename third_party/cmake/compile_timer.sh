#!/bin/sh
# compile_timer.sh COMPILER...: compiles, and leaves beside the object what that took of the processor, for
# tests/rules/compile_times.sh.
"$@" || exit
while [ $# -gt 1 ]; do
  if [ "$1" = -o ]; then times >"$2.times"; fi
  shift
done
