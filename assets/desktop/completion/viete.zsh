#compdef viete
# Completion for viete in zsh: the commands and options that its help lists, and files.
_viete_words() {
  viete "$@" --help 2>/dev/null | awk '/^[A-Z][a-z]*:$/ { part = $1 }
    part == "Commands:" && /^  [a-z]/ { print $1 }
    part == "Options:" && /^  -/ { for (i = 1; $i ~ /^-/; ++i) { sub(",$", "", $i); if ($i ~ /^--/) print $i } }'
}
_viete() {
  local -a command
  ((CURRENT > 2)) && [[ $words[2] != -* && $words[2] != help ]] && command=($words[2])
  [[ $words[2] == bench ]] && ((CURRENT > 3)) && command=(bench $words[3])
  compadd -- ${(f)"$(_viete_words $command)"}
  (($#command)) || compadd -- help ${(f)"$(_viete_words view)"}
  [[ $words[2] != help ]] || compadd -- deformers
  _files
}
_viete "$@"
