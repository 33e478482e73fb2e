# Makes the site: Doxygen reads the headers, Sphinx runs the examples and writes the pages, and their links are checked.
# Variables: source, sphinx, python, doxygen, katex, programs (separated by commas), results, python_package, site, work.
set(modules wavelets spectral fem contact solvers app)
set(inputs "")
foreach(module IN LISTS modules)
  string(APPEND inputs " \"${source}/${module}/include\"")
endforeach()
set(output ${work}/doxygen)
file(REMOVE_RECURSE ${site} ${work})
file(MAKE_DIRECTORY ${output})
configure_file(${source}/docs/Doxyfile.in ${work}/Doxyfile @ONLY)

function(run_step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(GET ARGN 0 program)
    message(FATAL_ERROR "${program} ended with ${code}; the site is not complete")
  endif()
endfunction()

set(package "")
file(GLOB core ${python_package}/wavebalance/_core*.so)
if(core)
  set(package ${python_package})
endif()
run_step(${doxygen} ${work}/Doxyfile)
run_step(${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${sphinx} -q -E -W --keep-going -b html
  -d ${work}/doctrees -D wavebalance_work=${work}/examples -D wavebalance_source=${source}
  -D wavebalance_programs=${programs} -D wavebalance_katex=${katex} -D wavebalance_doxygen=${output}/xml
  -D wavebalance_results=${results} -D wavebalance_python=${package} ${source}/docs ${site})
run_step(${python} ${source}/docs/check_links.py ${site})
message(STATUS "The site is ready: ${site}/index.html")
