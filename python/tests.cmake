# The tests of the package, by pytest in the build tree, one entry of CTest per file; examples run as they are.
function(wavebalance_add_python_test name)
  cmake_parse_arguments(PARSE_ARGV 1 T "" "LABEL" "COMMAND")
  add_test(NAME python.${name} COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_CURRENT_BINARY_DIR} MPLBACKEND=Agg
    PYTHONDONTWRITEBYTECODE=1 WAVEBALANCE_COMMAND=$<TARGET_FILE:wavebalance_command>
    WAVEBALANCE_REPORT_PAGE=$<$<TARGET_EXISTS:wavebalance_report_page>:$<TARGET_FILE:wavebalance_report_page>> ${sanitizers} ${Python_EXECUTABLE} ${T_COMMAND})
  set(timeout 240)
  if(sanitizers)
    set(timeout 2400)
  endif()
  set_tests_properties(python.${name} PROPERTIES LABELS ${T_LABEL} TIMEOUT ${timeout} SKIP_RETURN_CODE 77)
endfunction()

execute_process(COMMAND ${Python_EXECUTABLE} -c "import pytest" RESULT_VARIABLE no_pytest OUTPUT_QUIET ERROR_QUIET)
if(no_pytest)
  message(STATUS "Python package: its tests are left out, as pytest was not found (Debian: python3-pytest)")
else()
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/*_test.py)
  foreach(test IN LISTS tests)
    get_filename_component(name ${test} NAME_WE)
    wavebalance_add_python_test(${name} LABEL unit COMMAND -m pytest -q -p no:cacheprovider --rootdir ${CMAKE_CURRENT_SOURCE_DIR}/tests ${test})
  endforeach()
  # What a user sees, through the command and the package, without a compiler. Full campaigns of random structures take minutes.
  foreach(topic scenes analyses command compare laws structures impacts friction mixtures extremes tolerance)
    file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${topic}/*_test.py)
    foreach(test IN LISTS tests)
      get_filename_component(name ${test} NAME_WE)
      set(label scene)
      if(name STREQUAL every_analysis_test)
        set(label unit)  # which `make check` runs
      elseif(name MATCHES "^(random_(bars|chains|curves|friction_chains|friction_stability|impacts|mixtures|stability)|friction_sweeps)_test$")
        set(label campaign)
      elseif(topic STREQUAL extremes)
        set(label extremes)
      elseif(topic STREQUAL tolerance)
        set(label convergence)
      endif()
      wavebalance_add_python_test(${topic}_${name} LABEL ${label} COMMAND -m pytest -q -s -p no:cacheprovider --rootdir ${PROJECT_SOURCE_DIR}/tests ${test})
      if(label STREQUAL campaign)
        set_tests_properties(python.${topic}_${name} PROPERTIES TIMEOUT 3600)
      endif()
      if(topic MATCHES "extremes|tolerance")  # dense algebra, which takes one thread beside other tests
        set_tests_properties(python.${topic}_${name} PROPERTIES ENVIRONMENT OPENBLAS_NUM_THREADS=1)
      endif()
    endforeach()
  endforeach()
  # The cases of others, which are data, and what they are compared with.
  if(WAVEBALANCE_BUILD_REPRODUCE)
    foreach(name cases_test flows_test references_test)
      set(folder ${PROJECT_SOURCE_DIR}/reproduce/cases_of_others/tests)
      wavebalance_add_python_test(cases_of_others_${name} LABEL reference COMMAND -m pytest -q -p no:cacheprovider --rootdir ${folder} ${folder}/${name}.py)
    endforeach()
  endif()
  # What every page shows in a browser; skipped where chromium is absent.
  file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/pages/*_test.py)
  foreach(test IN LISTS tests)
    get_filename_component(name ${test} NAME_WE)
    wavebalance_add_python_test(pages_${name} LABEL paper COMMAND -m pytest -q -p no:cacheprovider --rootdir ${PROJECT_SOURCE_DIR}/tests/pages ${test})
    set_tests_properties(python.pages_${name} PROPERTIES TIMEOUT 600 RESOURCE_LOCK chromium)  # a minute alone, which takes both cores
  endforeach()
endif()
file(GLOB examples CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/examples/*.py)
foreach(example IN LISTS examples)
  get_filename_component(name ${example} NAME_WE)
  wavebalance_add_python_test(example_${name} LABEL reference COMMAND ${example})
endforeach()
file(GLOB notebooks CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/examples/*.ipynb)
foreach(notebook IN LISTS notebooks)
  get_filename_component(name ${notebook} NAME_WE)
  wavebalance_add_python_test(notebook_${name} LABEL reference
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/run_notebook.py ${notebook})
endforeach()

# The component alone is a whole package.
add_test(NAME python.installed_package_runs COMMAND ${CMAKE_COMMAND} -D build=${PROJECT_BINARY_DIR}
  -D stage=${CMAKE_CURRENT_BINARY_DIR}/stage -D folder=${WAVEBALANCE_PYTHON_DIR} -D python=${Python_EXECUTABLE}
  -D version=${PROJECT_VERSION} -P ${CMAKE_CURRENT_SOURCE_DIR}/tests/run_installed.cmake)
set_tests_properties(python.installed_package_runs PROPERTIES LABELS install TIMEOUT 120)
