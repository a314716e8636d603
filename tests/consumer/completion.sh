#!/bin/sh
# completion.sh PROGRAM DATA: the completions below DATA know every command, option and enumerated value of the program, and no other.
set -eu
program="$1" data="$2"
. "$(dirname "$0")/help_words.sh"

bash_file=$data/bash-completion/completions/viete
fish_file=$data/fish/vendor_completions.d/viete.fish
zsh_file=$data/zsh/site-functions/_viete

# in_bash LINE: what bash offers at the end of it. The functions of bash-completion are stood in for.
in_bash() {
  bash -c '
    _init_completion() { words=($line); [[ $line == *" " ]] && words+=(""); cword=$((${#words[@]} - 1))
      cur=${words[cword]} prev=${words[cword - 1]} split=false; }
    _filedir() { COMPREPLY+=("files:$1"); }
    complete() { :; }
    . "$1" && line=$2 && _viete && printf "%s\n" "${COMPREPLY[@]}"' bash "$bash_file" "$1" | sort
}
in_fish() {
  fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$fish_file" "$1" | cut -f 1 | sort
}

# same SHELL LINE EXPECTED: after LINE that shell offers the words expected.
same() {
  found=$("in_$1" "$2")
  [ "$found" = "$3" ] || wrong "$1 offers after '$2':
$found
and should offer:
$3"
}

check_shell() {
  all_commands | while read -r command; do
    same "$1" "viete $command --" "$(long_options_of $command)"
    for option in $(long_options_of $command); do
      values=$(values_of "$option" $command)
      [ -z "$values" ] || same "$1" "viete $command $option " "$values"
    done
  done
  same "$1" "viete --" "$({ long_options_of; long_options_of view; } | sort -u)"
  same "$1" "viete bench " "$(commands_of bench | sort)"
}

[ -n "$(values_of --method render)" ] || wrong "no values of --method in the help of render"

! command -v bash >/dev/null || check_shell bash
! command -v fish >/dev/null || check_shell fish
same bash "viete r" "$(printf '%s\n' 'files:@(obj|ply|off|stl|glb|gltf|viete)' render report)"
same bash "viete render a.ply -o " "files:@(png|svg|pfm)"
same bash "viete deform a.ply --pose " "files:@(obj|ply|off|stl|glb|gltf)"

# zsh needs a terminal to complete: at least its text has them all.
all_commands | while read -r command; do
  for option in $(long_options_of $command); do
    grep -q -e "[^a-z-]$option[^a-z-]" "$zsh_file" || wrong "$zsh_file: no $option"
    for value in $(values_of "$option" $command); do
      grep -q -e "$option=.*[( ]$value[ )]" "$zsh_file" || wrong "$zsh_file: $option has no $value"
    done
  done
done
! command -v zsh >/dev/null || zsh -n "$zsh_file"
