# Stages the components, then configures, builds and runs the consumer only against the stage.
include(${CMAKE_CURRENT_LIST_DIR}/run_command.cmake)

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
