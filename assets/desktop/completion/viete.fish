# Completion for viete in fish: the commands and options that its help lists, and files.
function __viete_words
    viete $argv --help 2>/dev/null | awk '/^[A-Z][a-z]*:$/ { part = $1 }
        part == "Commands:" && /^  [a-z]/ { print $1 }
        part == "Options:" && /^  -/ { for (i = 1; $i ~ /^-/; ++i) { sub(",$", "", $i); if ($i ~ /^--/) print $i } }'
end
function __viete_complete
    set -l words (commandline -opc)[2..-1]
    set -l command
    if set -q words[1]; and not string match -q -- '-*' $words[1]; and test $words[1] != help
        set command $words[1]
        test $command = bench; and set -q words[2]; and set -a command $words[2]
    end
    __viete_words $command
    set -q command[1]; or begin
        echo help
        set -q words[1]; and test $words[1] = help; and echo deformers
        __viete_words view
    end
end
complete -c viete -a '(__viete_complete)'
