#!/bin/sh
# help_pages.sh PROGRAM PAGE DATA: the manual page and shell completions must contain every command and option of the help.
set -eu
program="$1" page="$2" data="$3"
. "$(dirname "$0")/help_words.sh"

plain=$(sed 's/\\-/-/g' "$page")
all_commands | while read -r command; do
  echo "$plain" | grep -q -x -i ".SH $command" || wrong "$page has no section of $command"
  for option in $(long_options_of $command); do
    echo "$plain" | grep -q -e "$option" || wrong "$page has no $option"
  done
done
[ "$(all_commands | wc -l)" -gt 8 ] || wrong "$program --help names too few commands"
if command -v man >/dev/null && command -v groff >/dev/null; then
  said=$(MANROFFSEQ='' MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l "$page" 2>&1 >/dev/null)
  [ -z "$said" ] || wrong "$said"
fi

PATH=$(dirname "$program"):$PATH
# in_bash WORD...: prints the completions of the last word in bash.
in_bash() {
  bash -c '. "$1"; shift; COMP_WORDS=(viete "$@"); COMP_CWORD=$#; _viete; printf "%s\n" "${COMPREPLY[@]}"' \
    bash "$data/bash-completion/completions/viete" "$@" | sort -u
}
same() { [ "$1" = "$2" ] || wrong "bash offers $1 and should offer $2"; }
if command -v bash >/dev/null; then
  all_commands | while read -r command; do same "$(in_bash $command --)" "$(long_options_of $command)"; done
  same "$(in_bash r | tr '\n' ' ')" "render report "
  same "$(in_bash bench sy)" "sym3"
fi
if command -v fish >/dev/null; then
  fish --no-config -c 'source $argv[1]; complete -C "viete render --met"' "$data/fish/vendor_completions.d/viete.fish" |
    grep -q -- --method || wrong "fish does not complete --method"
fi
! command -v zsh >/dev/null || zsh -n "$data/zsh/site-functions/_viete"
