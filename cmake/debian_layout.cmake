# Before a Debian package is made: below /usr, Debian has one folder of Python packages for all versions.
file(GLOB folders ${CPACK_TEMPORARY_DIRECTORY}/usr/lib/python3.*/*-packages)
foreach(folder IN LISTS folders)
  file(COPY ${folder}/ DESTINATION ${CPACK_TEMPORARY_DIRECTORY}/usr/lib/python3/dist-packages)
  get_filename_component(parent ${folder} DIRECTORY)
  file(REMOVE_RECURSE ${parent})
endforeach()
