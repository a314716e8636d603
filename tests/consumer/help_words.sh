# Functions for other scripts, which read this file by `.`. The functions parse the output of $program --help.

# commands_of COMMAND...: prints the subcommands of the command, one per line.
commands_of() {
  "$program" "$@" --help | awk '/^[^ ]/ { on = tolower($0) ~ /commands:$/ } on && /^  [a-z]/ { print $1 }'
}

# all_commands: prints the commands that can be run, such as "view" and "bench exp", but not "bench".
all_commands() {
  for command in $(commands_of); do
    inner=$(commands_of "$command")
    [ -n "$inner" ] || echo "$command"
    for word in $inner; do echo "$command $word"; done
  done
}

# options_of COMMAND...: prints the options of the command, one per line, with all names: "-o --output".
options_of() {
  "$program" "$@" --help | awk '/^  -/ {
    names = ""
    while (match($0, /^[ ,]*--?[a-z][a-z-]*/)) {
      name = substr($0, RSTART, RLENGTH); sub(/^[ ,]*/, "", name)
      names = names " " name
      $0 = substr($0, RLENGTH + 1)
    }
    print substr(names, 2) }'
}

long_options_of() {
  options_of "$@" | tr ' ' '\n' | grep '^--' | sort
}

# values_of OPTION COMMAND...: prints the allowed values of an option. Reads them from the error message for an invalid value.
values_of() {
  option="$1" && shift
  if "$program" "$@" --help | grep -q -e "^  $option WORD"; then
    said=$("$program" "$@" "$option" '?????' 2>&1 || true)
    echo "$said" | sed -n 's/, not ?????$//; s/.*needs //p' | sed 's/, \| or /\n/g' | sort
  fi
}

wrong() {
  echo "$*" >&2
  exit 1
}
