# A project that needs a component that is not installed, or lacks its dependencies.
include(${CMAKE_CURRENT_LIST_DIR}/run_command.cmake)
set(stage ${folder}/stage)
file(REMOVE_RECURSE ${folder})
foreach(component package contact solvers)  # solvers without spectral
  run(${CMAKE_COMMAND} --install ${build} --prefix ${stage} --component ${component})
endforeach()
foreach(case "wavelets:wavelets" "solvers:spectral")
  string(REGEX MATCH "^[a-z]+" wanted ${case})
  string(REGEX MATCH "[a-z]+$" missing ${case})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${source}/tests/install/consumer -B ${folder}/${wanted} -G Ninja
      -DCMAKE_PREFIX_PATH=${stage} -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
      -DMODULE=${wanted} -DVERSION=${version}
    RESULT_VARIABLE result ERROR_VARIABLE text OUTPUT_QUIET)
  if(result EQUAL 0)
    message(FATAL_ERROR "component ${missing} is missing, and ${wanted} was found")
  endif()
  string(REGEX REPLACE "[ \n]+" " " text "${text}")
  expect("${text}" "without: ${missing}." "Installed there: contact, solvers." "for part in ${missing}; do cmake --install"
    "--prefix ${stage} --component $part")
endforeach()
