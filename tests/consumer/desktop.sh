#!/bin/sh
# desktop.sh DATA VERSION SOURCES: checks the desktop files. Uses the tools of freedesktop.org if they are installed.
# README, change log and AppStream data must contain this version.
set -eu
data="$1" version="$2" sources="$3"
entry=$data/applications/viete.desktop types=$data/mime/packages/viete.xml about=$data/metainfo/viete.metainfo.xml

wrong() {
  echo "$*" >&2
  exit 1
}

has() { command -v "$1" >/dev/null; }

! has desktop-file-validate || desktop-file-validate "$entry"
# The component name should begin with the project's domain. The project has no domain, so this check is off.
! has appstreamcli || appstreamcli validate --no-net --override=cid-desktopapp-is-not-rdns=info "$about"
for file in "$types" "$about" "$data/icons/hicolor/scalable/apps/viete.svg"; do
  test -s "$file"
  ! has xmllint || xmllint --noout "$file"
done

grep -q -x 'Icon=viete' "$entry"
for type in $(sed -n 's/^MimeType=//p' "$entry" | tr ';' ' '); do
  case $type in
    model/obj | model/stl) ;;  # the package shared-mime-info defines these types
    *) grep -q "<mime-type type=\"$type\">" "$types" || wrong "$types does not say what $type is" ;;
  esac
done

minor=${version%.*}
grep -q "<release version=\"$version\" " "$about" || wrong "$about knows no release $version"
grep -q "^## $version - " "$sources/CHANGELOG.md" || wrong "CHANGELOG.md tells nothing of $version"
grep -q -F "find_package(viete $minor REQUIRED)" "$sources/README.md" || wrong "README.md contains another version than $minor"
