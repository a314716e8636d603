#!/bin/sh
# pkg_config.sh PKGCONFIG_DIR COMPILER SOURCE README: builds the example as make does, then as in README.
set -eu
compiler="$2"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Calls eval, as make calls a shell, because pkg-config escapes blanks in paths.
export PKG_CONFIG_PATH="$1"
pkg-config --atleast-version=0.2 viete
eval "\"\$compiler\" -std=c++20 \"\$3\" $(pkg-config --cflags --libs viete) -o \"\$work/program\""
"$work/program"

# Runs the README's command with another compiler, and with a path without blanks.
line=$(sed -n 's/^g++ \(.*pkg-config.*\)/\1/p' "$4")
ln -s "$1" "$work/pkgconfig"
cp "$3" "$work/example.cpp"
cd "$work"
PKG_CONFIG_PATH="$work/pkgconfig" sh -euc "\"\$0\" $line" "$compiler"
