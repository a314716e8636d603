#!/bin/sh
# c.sh PKGCONFIG_DIR SOURCE: compiles the C header as C99, and links with the flags that the header documents.
set -eu
command -v cc >/dev/null || { echo "there is no C compiler: skipped"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PKG_CONFIG_PATH="$1"
eval "cc -std=c99 -pedantic -Wall -Werror \"\$2\" $(pkg-config --cflags --libs viete) -lstdc++ -lm -o \"\$work/program\""
"$work/program"
