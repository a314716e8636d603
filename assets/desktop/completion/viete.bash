# Completion for viete in bash: the commands and options that its help lists, and files.
_viete_words() {
  viete "$@" --help 2>/dev/null | awk '/^[A-Z][a-z]*:$/ { part = $1 }
    part == "Commands:" && /^  [a-z]/ { print $1 }
    part == "Options:" && /^  -/ { for (i = 1; $i ~ /^-/; ++i) { sub(",$", "", $i); if ($i ~ /^--/) print $i } }'
}
_viete() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words
  [[ $COMP_CWORD -gt 1 && ${command:0:1} != - ]] || command=
  [[ $command != bench || $COMP_CWORD -lt 3 ]] || command="bench ${COMP_WORDS[2]}"
  [[ $command != help ]] || command=
  words=$(_viete_words $command)
  [[ -n $command ]] || words+=" $(_viete_words view) help"
  [[ ${COMP_WORDS[1]} != help ]] || words+=" deformers"
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _viete viete
