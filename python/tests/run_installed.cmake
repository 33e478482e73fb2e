# Installs only the component python of `build` below `stage` and solves a scene with it, far from the sources.
file(REMOVE_RECURSE ${stage})
file(MAKE_DIRECTORY ${stage}/elsewhere)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --component python --prefix ${stage}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(program "
import wavebalance
assert wavebalance.__file__.startswith('${stage}'), wavebalance.__file__
assert wavebalance.__version__ == '${version}'
structure = wavebalance.Structure([[1.0]], [[0.1]], [[1.0]], [1.0], contacts=[0])
assert wavebalance.run(structure.scene(wavebalance.Penalty(5.0, 0.5), frequency=0.1)).converged
")
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${stage}/${folder} PYTHONDONTWRITEBYTECODE=1 ${python} -c "${program}"
  WORKING_DIRECTORY ${stage}/elsewhere COMMAND_ERROR_IS_FATAL ANY)
