"""Studies over what makes a structure solve each run with its own."""

import numpy as np

import wavebalance as wb

SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
modal_damping = 0.02
[contact]
law = "coulomb"
friction = 0.3
normal_load = 2.0
normal_stiffness = 1e4
tangential_stiffness = 1e4
[[contact.pairs]]
dofs = [1]
tangent = [2]
[forcing]
load_dofs = [3]
amplitude = 5.0
frequency = 4.0
[time]
trial = "fourier"
weight = "fourier"
functions = 15
[analysis]
type = "forced_response"
phases = false
stability = false
"""


def test_a_study_over_the_tangent_of_a_pair_solves_each_with_its_own(matrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matrix("m.mtx", np.diag([1.0, 1.5, 2.0]).tolist())
    matrix("k.mtx", [[3e3, -1e3, -5e2], [-1e3, 2e3, -4e2], [-5e2, -4e2, 2e3]])
    scales = [1.0, 0.25, 2.0, 0.5]
    table = wb.study(SCENE, {"contact.pairs[1].tangent_coefficients": [[one] for one in scales]}, output=tmp_path / "study", threads=1).table
    alone = [wb.run(SCENE, {"contact.pairs[1].tangent_coefficients": [one]}).summary["rms_displacement_m"] for one in scales]
    assert len(set(alone)) == len(scales)
    np.testing.assert_allclose(table["rms_displacement_m"], alone, rtol=1e-10)
