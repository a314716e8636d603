#!/bin/sh
# pkg_config.sh PKGCONFIG_DIR COMPILER SOURCE: builds and runs the example as a Makefile would.
set -eu
export PKG_CONFIG_PATH="$1"
program=$(mktemp)
trap 'rm -f "$program"' EXIT
# Through a shell, as make does it: blanks in a path come escaped.
eval "\"\$2\" -std=c++20 \"\$3\" $(pkg-config --cflags --libs viete) -o \"\$program\""
"$program"
pkg-config --atleast-version=0.2 viete
