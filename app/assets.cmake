# The styles and scripts of pages, as text in the program, and the libraries of others that pages may use.
set(folder ${CMAKE_CURRENT_SOURCE_DIR}/src/page/assets)
set(own_assets "")
foreach(name page.css page.js curves.js motion.js sums.js body.js)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${name})
  file(READ ${folder}/${name} text)
  string(APPEND own_assets "{\"${name}\", R\"wavebalance(${text})wavebalance\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/assets/own_assets.inc CONTENT "@own_assets@" @ONLY)

# The scenes that `wavebalance init` writes, in the order in which it lists them.
set(starters "")
foreach(kind bar matrices blade study)
  set(file ${CMAKE_CURRENT_SOURCE_DIR}/src/command/starters/${kind}.toml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND starters "{\"${kind}\", R\"wavebalance(${text})wavebalance\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/assets/starters.inc CONTENT "@starters@" @ONLY)
set_source_files_properties(src/command/starter_texts.cpp PROPERTIES
  INCLUDE_DIRECTORIES ${CMAKE_CURRENT_BINARY_DIR}/assets)

find_file(WAVEBALANCE_D3 d3.min.js PATHS /usr/share/nodejs/d3/dist NO_DEFAULT_PATH)
find_file(WAVEBALANCE_THREE three.min.js PATHS /usr/share/javascript/three/build /usr/share/javascript/three NO_DEFAULT_PATH)
find_file(WAVEBALANCE_KATEX katex.min.js PATHS /usr/share/javascript/katex NO_DEFAULT_PATH)
foreach(library D3 THREE KATEX)
  if(NOT WAVEBALANCE_${library})
    message(STATUS "Pages are made without ${library}, which is not installed (setup installs it)")
    set(WAVEBALANCE_${library} "")
  endif()
endforeach()
set_source_files_properties(src/page/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS "WAVEBALANCE_D3=\"${WAVEBALANCE_D3}\";WAVEBALANCE_THREE=\"${WAVEBALANCE_THREE}\";WAVEBALANCE_KATEX=\"${WAVEBALANCE_KATEX}\""
  INCLUDE_DIRECTORIES ${CMAKE_CURRENT_BINARY_DIR}/assets)
