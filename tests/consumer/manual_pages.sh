#!/bin/sh
# manual_pages.sh PROGRAM: the HTML manual must exist, chapters must be found by name, links must work, and pages must not need the network.
set -eu
program=$1
unset DISPLAY WAYLAND_DISPLAY  # no browser
page=$("$program" manual 2>&1) || { case $page in *"are not built"*) echo "skipped: $page"; exit 77 ;; esac; echo "$page"; exit 1; }
folder=$(dirname "$page")
for chapter in window cages blending time shapes files command_line python blender cpp figures; do
  [ "$("$program" manual $chapter)" = "$folder/$chapter.html" ] || { echo "there is no chapter $chapter"; exit 1; }
done
! "$program" manual nonsense 2>/dev/null
cd "$folder"
for file in *.html; do
  grep -o '\(href\|src\)="[^"]*"' "$file" | sed 's/^[a-z]*="//; s/"$//; s/#.*//' | while read -r link; do
    case $link in
      '' ) ;;
      http*) [ "$file" != "$link" ] ;;
      *) [ -e "$link" ] || { echo "$file links to $link, which does not exist"; exit 1; } ;;
    esac
  done
  ! grep -qE '<(script|link|iframe)|src="http' "$file" || { echo "$file asks for more than is there"; exit 1; }
done
