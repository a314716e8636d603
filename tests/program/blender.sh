#!/bin/sh
# blender.sh VIETE FOLDER: checks viete's files with Blender's importers. Without Blender, exits with 77 (skipped).
if ! command -v blender > /dev/null; then
  echo "skipped: Blender is not installed (apt-get install blender)"
  exit 77
fi
exec blender --background --factory-startup --python-exit-code 1 --python "$(dirname "$0")/blender.py" -- "$1" "$2"
