#!/bin/sh
# kernels_share_no_inline_function.sh NM "SOURCE.cpp ..." LIBRARY.a...: kernels may define inline functions
# and templates only in the namespaces N_* of their instruction sets. If several files define the same function
# elsewhere, the linker keeps one copy. This copy could use instructions that the processor does not have.
set -eu
nm="$1" sources="$2"
shift 2
list=$(mktemp)
trap 'rm -f "$list"' EXIT
for library in "$@"; do "$nm" "$library"; done >"$list"

status=0
for source in $sources; do
  symbols=$(sed -n "/^$(echo "$source" | sed 's/\./\\./g')\\.o:\$/,/^\$/p" "$list")
  [ -n "$symbols" ] || { echo "no object of $source in $*"; status=1; }
  shared=$(echo "$symbols" | grep ' [VWu] ' | grep -v -e '[0-9]N_' -e ' DW\.ref\.' || true)
  [ -z "$shared" ] || { echo "$source shares"; echo "$shared"; status=1; }
done
exit $status
