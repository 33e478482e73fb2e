# A study below mpirun, `mpirun -n 3 command`, has the rows of one process, but for their times.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}\n${output}")
  endif()
endfunction()

# Without the column `seconds`, the fifth.
function(rows_of result file)
  file(STRINGS ${file} lines)
  list(TRANSFORM lines REPLACE "^([^,]*,[^,]*,[^,]*,[^,]*),[^,]*," "\\1,")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${folder})
file(WRITE ${folder}/study.toml "scene = \"${scene}\"
[[parameters]]
key = \"forcing.frequency\"
from = 120.0
to = 160.0
count = 60
")
run(${command} study ${folder}/study.toml --output ${folder}/one)
run(${mpirun} --oversubscribe -n 3 ${command} study ${folder}/study.toml --output ${folder}/three)
rows_of(expected ${folder}/one/study.csv)
rows_of(found ${folder}/three/study.csv)
list(LENGTH found length)
if(NOT length EQUAL 61 OR NOT "${found}" STREQUAL "${expected}")
  message(FATAL_ERROR "three processes: ${found}\none: ${expected}")
endif()
file(READ ${folder}/three/summary.json summary)
if(NOT summary MATCHES "\"workers\": 3")
  message(FATAL_ERROR "not all processes solved runs: ${summary}")
endif()
