# Makes the pages of the results, with the commit of the sources where they are a git repository.
#   cmake -D source=<project> -D program=<wavebalance_report_page> -D results=<folder> -D compiler=<text> -P make_page.cmake
cmake_minimum_required(VERSION 3.25)
set(commit unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} -C ${source} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    execute_process(COMMAND ${git} -C ${source} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
    set(commit ${head})
    if(changes)
      string(APPEND commit " with changes that are not committed")
    endif()
  endif()
endif()
execute_process(COMMAND ${program} --results ${results} --commit "${commit}" --compiler "${compiler}"
  COMMAND_ERROR_IS_FATAL ANY)
