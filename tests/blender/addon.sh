#!/bin/sh
# addon.sh SOURCE PROGRAM MODULES FOLDER: tests the add-on in Blender. Without Blender, exits with 77 (skipped).
set -eu
command -v blender >/dev/null || { echo "skipped: Blender is not installed (apt-get install blender)"; exit 77; }
rm -rf "$4" && mkdir -p "$4"
PYTHONPATH=$3 PYTHONDONTWRITEBYTECODE=1 exec blender --background --python-use-system-env --factory-startup --python "$(dirname "$0")/addon.py" -- "$1/src/blender" "$2" "$4"
