# Writes the man page `output` from the help of `command`, the built program, so that both always agree.
function(said result)
  execute_process(COMMAND ${command} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "{false}" "" text "${text}")
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# itemised(result text): the lines "  name    what it is" as paragraphs with a heading each.
function(itemised result text)
  string(REGEX REPLACE "\n  ([^ \n]([^\n]*[^ \n])?)(  +|\n          +)([^ \n][^\n]*)" "\n.TP\n.B \\1\n\\4" text "\n${text}")
  string(REGEX REPLACE "\n(Usage:[^\n]*)" "\n.PP\n\\1" text "${text}")
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  string(REGEX REPLACE "\n([A-Z][a-z]+:)\n" "\n.PP\n\\1\n" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

said(version --version)
said(help --help)
said(keys keys)
string(REGEX REPLACE "^wavebalance ([^\n]*)\n.*$" "\\1" version "${version}")
string(REGEX REPLACE "\nUsage:.*$" "" description "${help}")
string(REGEX REPLACE "^.*\nSubcommands:\n" "" commands "${help}")
string(REGEX REPLACE "\n\n.*$" "" commands "${commands}")
string(REGEX MATCHALL "(^|\n)  [a-z]+ " names "${commands}")
string(REGEX REPLACE "^.*\nSubcommands:\n.*(A scene \\(.*)$" "\\1" example "${help}")

itemised(commands "${commands}\n")

set(page ".TH WAVEBALANCE 1 \"\" \"wavebalance ${version}\" \"User commands\"
.SH NAME
wavebalance \\- periodic vibrations of structures that touch obstacles
.SH SYNOPSIS
.nf
.B wavebalance COMMAND [ARGUMENTS]
.B wavebalance COMMAND \\-\\-help
.fi
.SH DESCRIPTION
${description}
.SH COMMANDS${commands}")
foreach(name IN LISTS names)
  string(STRIP "${name}" name)
  said(text ${name} --help)
  itemised(text "${text}")
  string(APPEND page ".SS wavebalance ${name}${text}")
endforeach()
string(APPEND page ".SH EXAMPLES AND EXIT STATUS
.nf
${example}
.fi
.SH KEYS OF A SCENE
.nf
${keys}
.fi
")
file(WRITE ${output} "${page}")
