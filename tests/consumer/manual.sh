#!/bin/sh
# manual.sh PROGRAM PAGE: the manual page names every command and option of the program, in the synopsis of the command and under
# OPTIONS, and no other; man finds nothing to say about it where man is installed.
set -eu
program="$1" page="$2"
. "$(dirname "$0")/help_words.sh"

plain=$(sed 's/\\-/-/g' "$page")
options=$(echo "$plain" | sed -n '/^\.SH OPTIONS/,/^\.SH ENVIRONMENT/p' | grep '^\.B')

check_command() {
  synopsis=$(echo "$plain" | sed -n "/^\.SY \"viete $*\"\$/,/^\.YS/p")
  [ -n "$synopsis" ] || wrong "$page: no synopsis of viete $*"
  options_of "$@" | grep -v -e --help | while read -r names; do
    found=""
    for name in $names; do
      echo "$synopsis" | grep -q -e "^\.OP $name\$" -e "^\.OP $name " -e "^\.B $name\$" && found=$name
      echo "$options" | grep -q -e "[ \"]$name\$" -e "[ \"]$name[ \"]" || wrong "$page: OPTIONS has no $name"
    done
    [ -n "$found" ] || wrong "$page: the synopsis of viete $* has no $names"
  done
  for name in $(echo "$synopsis" | sed -n 's/^\.\(OP\|B\) \(-[-a-z]*\).*/\2/p'); do
    options_of "$@" | tr ' ' '\n' | grep -q -x -e "$name" || wrong "$page: viete $* has no $name"
  done
}

all_commands | while read -r command; do check_command $command; done
[ "$(all_commands | wc -l)" -gt 8 ] || wrong "$program --help names too few commands"

grep -q "viete $("$program" --version | head -n 1 | cut -d ' ' -f 2)\"" "$page" || wrong "$page is of another version"
if command -v man >/dev/null && command -v groff >/dev/null; then
  said=$(MANROFFSEQ='' MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l "$page" 2>&1 >/dev/null)
  [ -z "$said" ] || wrong "$said"
fi
