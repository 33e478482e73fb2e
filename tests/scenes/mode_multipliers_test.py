"""Multipliers of nonlinear modes are near the exact motion's, and have no more digits than that."""

import pytest

MODE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [2]
[contact]
law = "linear"
stiffness = 30.0
gap = 1.0
[analysis]
type = "nonlinear_mode"
mode = 2
harmonics = 63
energy_ratio = 2.0
"""

EXACT = -4.69610958  # of the product of matrix exponentials over the intervals of the exact motion


@pytest.mark.parametrize("harmonics", [31, 63, 127])
def test_the_multiplier_of_a_mode_is_exact_to_its_stated_error(run, matrix, harmonics):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 1.0]])
    matrix("k.mtx", [[2.0, -1.0], [-1.0, 1.0]])
    summary = run(MODE, set=[f"analysis.harmonics={harmonics}"]).summary
    assert summary["unstable_multipliers"] == 1
    error = summary["leading_multiplier_error"]
    assert abs(summary["leading_multiplier_real"] - EXACT) <= max(error, 1e-8)
    assert error < 0.01 * abs(EXACT)
