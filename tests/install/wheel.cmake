# The wheel of the Python package is made, its RECORD holds, and it is imported from where pip, or unzip, puts it.
include(${CMAKE_CURRENT_LIST_DIR}/run_command.cmake)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/site)
run(${CMAKE_COMMAND} --install ${build} --component python --prefix ${folder}/stage)
run(${interpreter} ${source}/python/make_wheel.py ${folder}/stage/${packages}/wavebalance ${version}
  ${source}/python/README.md ${folder})
file(GLOB wheel ${folder}/wavebalance-${version}-*.whl)
run(${interpreter} -c "
import base64, csv, hashlib, io, zipfile
archive = zipfile.ZipFile('${wheel}')
rows = list(csv.reader(io.StringIO(archive.read('wavebalance-${version}.dist-info/RECORD').decode())))
assert sorted(row[0] for row in rows) == sorted(archive.namelist()), rows
for name, digest, size in rows[:-1]:
    content = archive.read(name)
    found = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()
    assert (digest, size) == ('sha256=' + found, str(len(content))), name
")
execute_process(COMMAND ${interpreter} -m pip --version RESULT_VARIABLE without_pip OUTPUT_QUIET ERROR_QUIET)
if(without_pip)
  run(${interpreter} -m zipfile -e ${wheel} ${folder}/site)
else()
  run(${interpreter} -m pip install --no-index --no-deps --no-cache-dir --target ${folder}/site ${wheel})
endif()
run(${CMAKE_COMMAND} -E env PYTHONPATH=${folder}/site ${interpreter} -B -c "
import wavebalance
assert wavebalance.__file__.startswith('${folder}/site/'), wavebalance.__file__
structure = wavebalance.Structure([[1.0]], [[0.1]], [[1.0]], [1.0], contacts=[0])
assert wavebalance.forced_response(structure, wavebalance.Penalty(5.0, 0.5), 0.1).converged
print('converged')
")
expect("${output}" "converged")
execute_process(COMMAND ${interpreter} ${source}/python/make_wheel.py ${folder}/site/nothing ${version}
  ${source}/python/README.md ${folder} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "a wheel was made of a folder without a package")
endif()
expect("${output}" "has no compiled module _core")
