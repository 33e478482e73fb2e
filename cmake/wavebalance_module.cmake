# wavebalance_add_module(name SOURCES <files> HEADERS <files> [MODULES <sibling modules>]
#                        [PUBLIC <targets>] [PRIVATE <targets>] [FIND "<arguments of find_dependency>"...])
# declares the library wavebalance::<name> and the package component <name>. Sources include private headers by their
# path below src/.
function(wavebalance_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 M "" "" "SOURCES;HEADERS;MODULES;PUBLIC;PRIVATE;FIND")
  set(target wavebalance_${name})
  foreach(sibling IN LISTS M_MODULES)
    if(NOT TARGET wavebalance_${sibling})
      message(FATAL_ERROR "WAVEBALANCE_MODULES is \"${WAVEBALANCE_MODULES}\": module ${name} needs ${sibling} before it")
    endif()
  endforeach()
  list(TRANSFORM M_MODULES PREPEND wavebalance:: OUTPUT_VARIABLE siblings)
  add_library(${target})
  add_library(wavebalance::${name} ALIAS ${target})
  set(interface ${PROJECT_VERSION_MAJOR})
  if(interface EQUAL 0)
    set(interface 0.${PROJECT_VERSION_MINOR})  # before 1.0 the interface changes with the minor version
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${interface}
    INSTALL_RPATH "\$ORIGIN")  # shared libraries find each other
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_sources(${target} PRIVATE ${M_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${M_HEADERS})
  target_include_directories(${target} PRIVATE src)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
  target_link_libraries(${target} PUBLIC ${siblings} ${M_PUBLIC} PRIVATE ${M_PRIVATE})
  if(BUILD_SHARED_LIBS)
    wavebalance_export_headers(${target} ${M_HEADERS})
  elseif("Eigen3::Eigen" IN_LIST M_PUBLIC)
    wavebalance_precompile_headers(${target})
  endif()
  wavebalance_set_warnings(${target})
  set_property(TARGET ${target} PROPERTY WAVEBALANCE_PACKAGES "${M_FIND}")

  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wavebalance)
  install(TARGETS ${target} EXPORT ${target}-targets COMPONENT ${name} FILE_SET HEADERS COMPONENT ${name})
  install(EXPORT ${target}-targets NAMESPACE wavebalance:: DESTINATION ${package_dir} COMPONENT ${name})
  set(text "")
  foreach(module IN LISTS M_MODULES)
    string(APPEND text "include(\${CMAKE_CURRENT_LIST_DIR}/wavebalance_${module}.cmake)\n")
  endforeach()
  foreach(dependency IN LISTS M_FIND)
    string(APPEND text "find_dependency(${dependency})\n")
  endforeach()
  string(APPEND text "include(\${CMAKE_CURRENT_LIST_DIR}/${target}-targets.cmake)\n")
  string(APPEND text "set(wavebalance_${name}_FOUND TRUE)\n")
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/wavebalance_${name}.cmake "include_guard()\n${text}")
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/wavebalance_${name}.cmake DESTINATION ${package_dir} COMPONENT ${name})
  wavebalance_install_pkg_config(${name} MODULES ${M_MODULES} FIND ${M_FIND})
  wavebalance_install_licence(${name})
  set_property(GLOBAL APPEND PROPERTY WAVEBALANCE_INSTALLED_MODULES ${name})
  if(M_MODULES)
    list(JOIN M_MODULES " " needed)
    set_property(GLOBAL APPEND PROPERTY WAVEBALANCE_MODULE_NEEDS
      "if(${name} IN_LIST _wavebalance_needed)\n  list(APPEND _wavebalance_needed ${needed})\nendif()")
  endif()
endfunction()

# wavebalance_add_room(room SOURCES <names> HEADERS <names>) appends src/<room>/<name>.cpp to `sources`, all of the folder but
# main.cpp where no names are given, and <include>/<room>/<name>.hpp to `headers`, where the variable `include` names the
# module's folder of public headers.
function(wavebalance_add_room room)
  cmake_parse_arguments(PARSE_ARGV 1 R "" "" "SOURCES;HEADERS")
  list(TRANSFORM R_SOURCES REPLACE "(.+)" "src/${room}/\\1.cpp")
  if(NOT R_SOURCES)
    file(GLOB_RECURSE R_SOURCES RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS src/${room}/*.cpp)
    list(FILTER R_SOURCES EXCLUDE REGEX "/main\\.cpp$")
  endif()
  set_source_files_properties(${R_SOURCES} PROPERTIES UNITY_GROUP ${room})
  list(TRANSFORM R_HEADERS REPLACE "(.+)" "${include}/${room}/\\1.hpp")
  set(sources ${sources} ${R_SOURCES} PARENT_SCOPE)
  set(headers ${headers} ${R_HEADERS} PARENT_SCOPE)
endfunction()

# wavebalance_precompile_headers(target): headers that nearly every source parses, compiled once for all modules.
# Parsing Eigen/Core takes longer than compiling most sources.
function(wavebalance_precompile_headers target)
  if(NOT TARGET wavebalance_headers)
    find_package(Eigen3 3.4 CONFIG REQUIRED)
    set(source ${PROJECT_BINARY_DIR}/headers.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "")
    add_library(wavebalance_headers STATIC ${source})
    target_compile_features(wavebalance_headers PRIVATE cxx_std_20)
    target_link_libraries(wavebalance_headers PRIVATE Eigen3::Eigen)
    target_compile_options(wavebalance_headers PRIVATE $<$<CONFIG:Release>:-O2>)
    wavebalance_set_warnings(wavebalance_headers)
    target_precompile_headers(wavebalance_headers PRIVATE <Eigen/Core> <Eigen/SparseCore> <algorithm> <cmath>
      <functional> <limits> <memory> <stdexcept> <string> <vector>)
  endif()
  target_precompile_headers(${target} REUSE_FROM wavebalance_headers)
endfunction()

# wavebalance_export_headers(target <headers>): a shared library exports what its public headers declare, and nothing
# else. All of them are in the precompiled header, between two pragmas, so that no header needs a macro at each
# function.
function(wavebalance_export_headers target)
  list(TRANSFORM ARGN REPLACE "^include/(.*)$" "#include <\\1>" OUTPUT_VARIABLE lines)
  list(JOIN lines "\n" lines)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/${target}_exports.hpp)
  file(CONFIGURE OUTPUT ${header} @ONLY
    CONTENT "#pragma GCC visibility push(default)\n@lines@\n#pragma GCC visibility pop\n")
  target_precompile_headers(${target} PRIVATE ${header})
  # Members of types of Eigen, which stay hidden: each library has its own copy.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-attributes>)
endfunction()

# wavebalance_use_private_parts(test <modules>): lets the test use parts that shared libraries of these modules do not
# export. It then links their objects in addition to the libraries.
function(wavebalance_use_private_parts test)
  if(NOT BUILD_SHARED_LIBS OR NOT TARGET ${test})
    return()
  endif()
  foreach(module IN LISTS ARGN)
    target_sources(${test} PRIVATE $<TARGET_OBJECTS:wavebalance_${module}>)
    # Targets of packages are known to the folder that has found them.
    get_property(packages TARGET wavebalance_${module} PROPERTY WAVEBALANCE_PACKAGES)
    foreach(package IN LISTS packages)
      separate_arguments(package)
      find_package(${package} REQUIRED)
    endforeach()
    get_property(libraries TARGET wavebalance_${module} PROPERTY LINK_LIBRARIES)
    target_link_libraries(${test} PRIVATE ${libraries})
  endforeach()
endfunction()

# wavebalance_set_hot(<sources>): loops that -O3 makes faster than the -O2 of all other sources.
function(wavebalance_set_hot)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
endfunction()

# wavebalance_set_cold(target): compiled for its compile time, as nothing in it computes for long. At -O1 gcc 12
# reports array bounds and uninitialised values that do not exist.
function(wavebalance_set_cold target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-maybe-uninitialized;-Wno-stringop-overflow;-Wno-stringop-overread>")
endfunction()

# wavebalance_set_coldest(<sources>): read a command line and nothing else. Without optimization the compiler takes two
# thirds of the time. Precompiled headers are made with optimization, so these sources cannot use them.
function(wavebalance_set_coldest)
  set_source_files_properties(${ARGN} PROPERTIES
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O0> SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# wavebalance_set_warnings(target): the warnings that all of our targets are held to. GCC 12 reports "literal" + string
# as overlapping memory (GCC bug 105651).
function(wavebalance_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<BOOL:${WAVEBALANCE_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
