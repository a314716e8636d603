# Sourced by the scripts of this folder. Sets the folders, and the program: the first argument, or that of the build folder.
here=$(cd "$(dirname "$0")" && pwd)
viete=${1:-$here/../../build/viete}
dragon=$(cd "$here/../dragon" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
