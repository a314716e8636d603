#!/bin/sh
# Run this manually, as root, before a release. Runs the README's two commands on minimal systems of other Debian releases.
#   tests/releases/try_release.sh [-k] [-f FOLDER] bookworm trixie testing
# For each release: makes a minimal root by mmdebstrap, copies the committed sources, and runs `setup.sh` until it makes a
# picture, and `setup.sh test`. Prints the times. -k keeps the roots, so that the next run installs nothing. -f sets the folder
# of the roots. Downloads only from Debian's archive. Each root has its own /tmp and /proc.
set -eu
here=$(CDPATH='' cd -P -- "$(dirname -- "$(readlink -f -- "$0")")/../.." && pwd)
keep="" folder=${TMPDIR:-/tmp}/viete-releases
while getopts kf: option; do
  case $option in
    k) keep=1 ;;
    f) folder=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] || set -- bookworm trixie testing
[ "$(id -u)" = 0 ] || { echo "try_release.sh: making a root needs root" >&2; exit 1; }
command -v mmdebstrap >/dev/null || { echo "try_release.sh: apt-get install mmdebstrap" >&2; exit 1; }

# Ignores the date in the Release file of testing, because mirrors may be old.
stale='Acquire::Check-Valid-Until "false";'

# inside ROOT COMMAND: runs the command in the root, without environment variables of this machine.
inside() {
  chroot "$1" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 sh -c "$2"
}

unmount() {
  for place in proc dev; do
    if mountpoint -q "$1/$place"; then umount "$1/$place"; fi
  done
}

enter() {
  mountpoint -q "$1/proc" || mount -t proc proc "$1/proc"
  mountpoint -q "$1/dev" || mount --bind /dev "$1/dev"
  for file in /etc/resolv.conf /etc/hosts; do [ ! -e $file ] || cp $file "$1/etc/"; done
  echo "$stale" >"$1/etc/apt/apt.conf.d/99stale"
}

# timed NAME ROOT COMMAND: runs the command in the root, and prints its time.
timed() {
  begun=$(date +%s)
  if inside "$2" "$3" >"$folder/$1.log" 2>&1; then result="done"; else result="FAILED"; fi
  echo "$1: $result after $(($(date +%s) - begun)) s; $folder/$1.log"
  [ $result = "done" ]
}

try() {
  root=$folder/$1
  [ -d "$root" ] || mmdebstrap --quiet --variant=minbase --aptopt="$stale" "$1" "$root"
  enter "$root"
  rm -rf "$root/viete"
  mkdir "$root/viete"
  git -C "$here" archive HEAD | tar -x -C "$root/viete"
  timed "$1-deps" "$root" '/viete/third_party/setup.sh deps' &&
    timed "$1-picture" "$root" 'cd /tmp && rm -f viete*.png && /viete/third_party/setup.sh && ls -l viete.png' &&
    timed "$1-test" "$root" '/viete/third_party/setup.sh test' || failed="$failed $1"
  tail -n 3 "$folder/$1-test.log" 2>/dev/null || true
}

mkdir -p "$folder"
failed=""
root=""
trap '[ -z "$root" ] || unmount "$root"' EXIT
for release in "$@"; do
  try "$release"
  unmount "$root"
  if [ -z "$keep" ]; then rm -rf --one-file-system "$root"; fi
done
[ -z "$failed" ] || { echo "not as it should be:$failed"; exit 1; }
