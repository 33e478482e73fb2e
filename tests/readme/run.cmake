# Runs the command blocks of README.md in a fresh clone of `source` in `folder`, in order. To keep the suite short the
# clone uses the finished build tree `build`, and `make TARGET` there checks that the Makefile has the target and that
# it builds the command; `.ci/run` runs the same blocks without such a replacement.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
endfunction()

set(clone ${folder}/clone)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/bin)
if(EXISTS ${source}/.git)
  run(git clone --quiet ${source} ${clone})
else()
  file(COPY ${source}/ DESTINATION ${clone} PATTERN build EXCLUDE PATTERN results EXCLUDE)
endif()
run(sh -n ${clone}/setup)
file(WRITE ${clone}/setup "#!/bin/sh\n")  # what it would install is there, or nothing would have been built
file(MAKE_DIRECTORY ${clone}/build)
file(CREATE_LINK ${build} ${clone}/build/default SYMBOLIC)

find_program(make make REQUIRED)
file(CONFIGURE OUTPUT ${folder}/bin/make @ONLY CONTENT [=[#!/bin/sh
# Stands for `make` and `make TARGET`.
set -eu
@make@ -n "$@" > /dev/null
target=${1-command}
case $target in test) target=all ;; command) target=wavebalance_command ;; esac
@ninja@ -C @build@ -t commands "$target" | grep -q -e ' -o wavebalance ' || {
  echo "make $* does not build the command" >&2
  exit 1
}
]=])
file(CHMOD ${folder}/bin/make FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
run(${CMAKE_COMMAND} -E env PATH=${folder}/bin:$ENV{PATH} ${clone}/tests/readme/run_blocks.sh ${clone})
