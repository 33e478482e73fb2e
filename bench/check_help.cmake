# cmake -D program=FILE -P check_help.cmake: --help shows the usage and the measurements, and unknown options are
# named.
execute_process(COMMAND ${program} --help RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
foreach(part "usage: wavebalance_bench" "Writes [a-z_]+\\.csv" "--output DIR" "--quick")
  if(NOT code EQUAL 0 OR NOT out MATCHES "${part}")
    message(FATAL_ERROR "--help exits with ${code} and says\n${out}${err}\nwithout \"${part}\"")
  endif()
endforeach()
execute_process(COMMAND ${program} --sceen x RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
if(NOT code EQUAL 2 OR NOT err MATCHES "argument \"--sceen\"; allowed: --output DIR")
  message(FATAL_ERROR "--sceen exits with ${code} and says\n${out}${err}")
endif()
