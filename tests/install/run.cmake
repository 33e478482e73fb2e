# Stages the components, then configures, builds and runs the consumer against the stage alone.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${stage} ${binary})
string(REPLACE "," ";" components "${components}")
foreach(component IN LISTS components)
  if(component)
    run(${CMAKE_COMMAND} --install ${build} --prefix ${stage} --component ${component})
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${source}/consumer -B ${binary} -G Ninja -DCMAKE_PREFIX_PATH=${stage}
  -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_FLAGS=${flags}
  -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DMODULE=${module} -DVERSION=${version})
run(${CMAKE_COMMAND} --build ${binary})
run(${binary}/consumer)
