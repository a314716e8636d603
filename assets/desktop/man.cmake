# Writes the manual page from the help of every command: cmake -DPROGRAM=viete -DVERSION=0.2.0 -DTO=viete.1 -P man.cmake
function(append_help title)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\\" "\\e" help "${help}")
  string(REPLACE "-" "\\-" help "${help}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" help "${help}")
  file(APPEND ${TO}.part ".SH ${title}\n.nf\n${help}.fi\n")
endfunction()
function(commands_of result)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "\nCommands:\n(.*)\nOptions:" part "${help}")
  string(REGEX MATCHALL "\n  [a-z0-9]+ " names "\n${CMAKE_MATCH_1}")
  list(TRANSFORM names STRIP)
  set(${result} ${names} PARENT_SCOPE)
endfunction()

file(WRITE ${TO}.part ".TH VIETE 1 \"\" \"viete ${VERSION}\"\n.SH NAME\nviete \\- deform a mesh by its cage\n")
append_help(SYNOPSIS)
commands_of(commands)
foreach(command IN LISTS commands)
  string(TOUPPER ${command} title)
  append_help(${title} ${command})
endforeach()
append_help(DEFORMERS help deformers)
commands_of(benchmarks bench)
foreach(command IN LISTS benchmarks)
  string(TOUPPER "BENCH ${command}" title)
  append_help(${title} bench ${command})
endforeach()
file(APPEND ${TO}.part ".SH ENVIRONMENT
.TP
.B XDG_STATE_HOME
Absolute path of the folder for unsaved edits; ~/.local/state by default.
.TP
.B VIETE_IMPORT
The program that reads FBX, Collada, compressed glTF and other files; by default viete-import beside viete or in PATH.
.SH FILES
.TP
.I ~/.local/state/viete
Unsaved edits, which the next start offers to restore, and settings of the window.
")
file(RENAME ${TO}.part ${TO})
