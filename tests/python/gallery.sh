#!/bin/sh
# gallery.sh PYTHON SOURCE FOLDER EXAMPLE: runs all scripts of the gallery, and the README's example, in FOLDER.
set -eu
python=$1 source=$2 folder=$3 example=$4
rm -rf "$folder" && mkdir -p "$folder"
ln -s "$source/assets" "$folder/assets"
cd "$folder"
for script in "$source"/src/python/gallery/*.py; do
  [ "$(wc -l <"$script")" -lt 30 ] || { echo "$script has thirty lines or more"; exit 1; }
  grep -q "$(basename "$script")" "$source/src/python/gallery/README.md" || { echo "its README does not name $script"; exit 1; }
  said=$("$python" "$script")
  echo "$(basename "$script"): $said"
  echo "$said" | grep -q '[0-9]' || { echo "$script prints no number"; exit 1; }
done
for file in alert twisted pulled; do [ -s $file.ply ]; done
rm alert.ply
"$python" "$example"
[ -s alert.ply ]
