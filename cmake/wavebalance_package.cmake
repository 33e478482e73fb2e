# Installed parts in addition to libraries and headers, the Debian package, and the target that builds all of it.

# wavebalance_install_licence(component): every component states its licences.
function(wavebalance_install_licence component)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/cmake/copyright
    DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})
endfunction()

# wavebalance_pkg_config_flags(result <library files>): "-L<folder> -l<name>" for each, in their order.
function(wavebalance_pkg_config_flags result)
  set(flags "")
  foreach(library IN LISTS ARGN)
    get_filename_component(name ${library} NAME_WE)
    get_filename_component(folder ${library} DIRECTORY)
    string(REGEX REPLACE "^lib" "" name ${name})
    if(NOT folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
      string(APPEND flags " -L${folder}")
    endif()
    string(APPEND flags " -l${name}")
  endforeach()
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()

# wavebalance_install_pkg_config(module MODULES <siblings> FIND <arguments of find_dependency>) installs
# wavebalance-<module>.pc. A static library brings what it links to every program; a shared one keeps it to itself.
function(wavebalance_install_pkg_config module)
  cmake_parse_arguments(PARSE_ARGV 1 P "" "" "MODULES;FIND")
  list(TRANSFORM P_MODULES REPLACE "(.+)" "wavebalance-\\1 = ${PROJECT_VERSION}" OUTPUT_VARIABLE requires)
  set(inner "")
  set(libraries "")
  foreach(dependency IN LISTS P_FIND)
    if(dependency MATCHES "^Eigen3 ([0-9.]+)")
      list(APPEND requires "eigen3 >= ${CMAKE_MATCH_1}")
    elseif(dependency MATCHES "^GSL ([0-9.]+)")
      list(APPEND inner "gsl >= ${CMAKE_MATCH_1}")
    elseif(dependency STREQUAL "FFTW3")
      list(APPEND inner fftw3)
    elseif(dependency STREQUAL "LAPACKE")
      list(APPEND libraries ${LAPACKE_LIBRARY} ${LAPACKE_BLAS_LIBRARY})
    elseif(dependency MATCHES "^(CHOLMOD|UMFPACK)$")
      list(APPEND libraries ${${dependency}_LIBRARY})
    else()
      message(FATAL_ERROR "wavebalance-${module}.pc: what does ${dependency} link?")
    endif()
  endforeach()
  wavebalance_pkg_config_flags(flags ${libraries})
  set(libs "Libs: -L\${libdir} -lwavebalance_${module}")
  if(BUILD_SHARED_LIBS)
    string(APPEND libs "\nLibs.private:${flags}")
  else()
    string(APPEND libs "${flags}")
    list(APPEND requires ${inner})
    set(inner "")
  endif()
  list(JOIN requires ", " requires)
  list(JOIN inner ", " inner)
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" up "${up}")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/wavebalance-${module}.pc @ONLY CONTENT
"prefix=\${pcfiledir}/@up@
libdir=\${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: wavebalance-@module@
Description: Periodic vibrations with contact, module @module@ (C++20)
Version: @PROJECT_VERSION@
Requires: @requires@
Requires.private: @inner@
@libs@
Cflags: -I\${includedir}
")
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/wavebalance-${module}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${module})
endfunction()

# wavebalance_install_package(): the package file that finds components, the component dev, and the Debian package.
# Called once, last.
function(wavebalance_install_package)
  get_property(WAVEBALANCE_INSTALLED_MODULES GLOBAL PROPERTY WAVEBALANCE_INSTALLED_MODULES)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wavebalance)
  list(JOIN WAVEBALANCE_INSTALLED_MODULES ", " WAVEBALANCE_COMPONENT_NAMES)
  get_property(needs GLOBAL PROPERTY WAVEBALANCE_MODULE_NEEDS)
  list(JOIN needs "\n" WAVEBALANCE_NEEDS)
  configure_package_config_file(cmake/wavebalanceConfig.cmake.in wavebalanceConfig.cmake
    INSTALL_DESTINATION ${package_dir})
  write_basic_package_version_file(wavebalanceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/wavebalanceConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/wavebalanceConfigVersion.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake ${PROJECT_SOURCE_DIR}/cmake/FindFFTW3.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindLAPACKE.cmake ${PROJECT_SOURCE_DIR}/cmake/FindUMFPACK.cmake
    DESTINATION ${package_dir} COMPONENT package)
  wavebalance_install_licence(package)

  set(components package ${WAVEBALANCE_INSTALLED_MODULES})
  list(TRANSFORM WAVEBALANCE_INSTALLED_MODULES PREPEND wavebalance_ OUTPUT_VARIABLE targets)
  wavebalance_install_dev(${components})
  if(TARGET wavebalance_command)
    list(APPEND components command)
    list(APPEND targets wavebalance_command)
  endif()
  if(TARGET wavebalance_mpi)
    list(APPEND targets wavebalance_mpi)  # a Debian package of its own, so that the first one does not depend on MPI
  endif()
  if(TARGET wavebalance_python)
    list(APPEND components python)
    list(APPEND targets wavebalance_python)
  endif()
  if(PROJECT_IS_TOP_LEVEL)
    add_custom_target(wavebalance_installed DEPENDS ${targets})
    wavebalance_install_pages()
    wavebalance_add_debian_package(${components} doc)
    wavebalance_add_other_packages()
  endif()
endfunction()

# wavebalance_install_pages(): README.md with the pages that it leads to, example scenes and recipes, as the component doc. They
# have the places of the sources, so that links between them hold.
function(wavebalance_install_pages)
  file(GLOB pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/*.md ${PROJECT_SOURCE_DIR}/*/*.md
    ${PROJECT_SOURCE_DIR}/reproduce/*/README.md ${PROJECT_SOURCE_DIR}/reproduce/*/modes/README.md)
  foreach(page IN LISTS pages ITEMS CITATION.cff docs/did_not_converge.rst docs/limits.rst app/aperiodic.png app/overlay.png
          reproduce/picture.png reproduce/speed.png)
    get_filename_component(folder ${page} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT doc)
  endforeach()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/reproduce/scenes DESTINATION ${CMAKE_INSTALL_DOCDIR}/reproduce COMPONENT doc)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/recipes ${PROJECT_SOURCE_DIR}/docs/theory
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT doc)
endfunction()

# wavebalance_add_other_packages(): the target wavebalance_packages makes the other packages: a package of the
# component mpi, and a wheel of the Python package.
function(wavebalance_add_other_packages)
  set(folder ${PROJECT_SOURCE_DIR}/build)
  add_custom_target(wavebalance_packages DEPENDS wavebalance_installed)
  if(TARGET wavebalance_mpi)
    set(config ${PROJECT_BINARY_DIR}/CPackMpiConfig.cmake)
    file(CONFIGURE OUTPUT ${config} @ONLY CONTENT [=[include(@PROJECT_BINARY_DIR@/CPackConfig.cmake)
set(CPACK_PACKAGE_NAME wavebalance-mpi)
set(CPACK_DEBIAN_PACKAGE_NAME wavebalance-mpi)
set(CPACK_INSTALL_CMAKE_PROJECTS "@PROJECT_BINARY_DIR@;wavebalance;mpi;/")
set(CPACK_DEBIAN_PACKAGE_DEPENDS "wavebalance (= @PROJECT_VERSION@)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Studies of wavebalance on many machines:
what mpirun -n K wavebalance study needs beside the package wavebalance.")
]=])
    add_custom_command(TARGET wavebalance_packages POST_BUILD VERBATIM
      COMMAND ${CMAKE_CPACK_COMMAND} -G DEB --config ${config} -B ${folder})
  endif()
  if(TARGET wavebalance_python)
    set(stage ${PROJECT_BINARY_DIR}/python/wheel)
    add_custom_command(TARGET wavebalance_packages POST_BUILD VERBATIM
      COMMAND ${CMAKE_COMMAND} -E rm -rf ${stage}
      COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --component python --prefix ${stage}
      COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/python/make_wheel.py ${stage}/${WAVEBALANCE_PYTHON_DIR}/wavebalance
        ${PROJECT_VERSION} ${PROJECT_SOURCE_DIR}/python/README.md ${folder})
  endif()
endfunction()

# wavebalance_install_dev(<components>): the component dev depends on all of these.
function(wavebalance_install_dev)
  install(CODE "
    foreach(component ${ARGN})
      execute_process(COMMAND \${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix \${CMAKE_INSTALL_PREFIX}
        --component \${component} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()" COMPONENT dev EXCLUDE_FROM_ALL)
endfunction()

# wavebalance_add_debian_package(<components>): `cpack -G DEB` makes one package of these, below /usr.
function(wavebalance_add_debian_package)
  foreach(component IN LISTS ARGN)
    list(APPEND CPACK_INSTALL_CMAKE_PROJECTS ${PROJECT_BINARY_DIR} wavebalance ${component} /)
  endforeach()
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME wavebalance)
  set(CPACK_PACKAGE_CONTACT "The Wavebalance authors")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_layout.cmake)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, node-d3, libjs-three, libjs-katex, bash-completion")
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, libeigen3-dev, libfftw3-dev, libgsl-dev, liblapacke-dev, \
libopenblas-pthread-dev, libsuitesparse-dev")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "The command wavebalance solves scenes by harmonic
and wavelet balance, with stability, sweeps and nonlinear modes. The C++20
libraries behind it are static; programs that use them need the suggested
packages.")
  if(TARGET wavebalance_python)
    math(EXPR next "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next}), python3-numpy, python3-scipy")
    string(PREPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, ")
  endif()
  include(CPack)
endfunction()
