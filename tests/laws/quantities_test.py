"""Values of records by their names: what studies keep of them and what pictures call them."""

import re

import numpy as np
import pytest
from scene_texts import STOP_AT

import wavebalance as wb

UNITS = {"_m": "mm", "_N": "N", "_J": "J", "_Hz": "Hz", "_m3": "m3"}  # as a name ends, and as a picture shows it
STOP = STOP_AT + """type = "amplitude_sweep"
amplitude_from = 0.05
amplitude_to = 0.5
stability = false
phases = false
"""
OF_A_RESPONSE = ("frequency_Hz", "max_displacement_m", "min_displacement_m", "rms_displacement_m", "vibration_m",
                 "rms_vibration_m", "max_contact_force_N", "residual")
OF_A_CURVE = ("amplitude_at_max_displacement_N", "amplitude_at_largest_vibration_N", "max_contact_force_N")
OF_FRICTION = ("friction_work_J", "wear_m3")


def label_of(column):
    """The words and the unit of a column from its name."""
    for end, unit in UNITS.items():
        if column.endswith(end):
            return f"{column.removesuffix(end).replace('_', ' ')} ({unit})"
    return column


@pytest.fixture(scope="module")
def scene_of(scenes_folder):
    bar = (scenes_folder / "jones_legrand_2014" / "case1.toml", {"contact.gap": [1e-3, 2e-3]})
    return {"response": bar, "curve": (STOP, {"contact.gap": [1.0, 1.1]}),
            "friction": (scenes_folder / "friction" / "lift_off.toml", {"contact.wear_coefficient": [1e-14, 2e-14]})}


@pytest.mark.parametrize("scene, quantity", [
    *(("response", one) for one in OF_A_RESPONSE), *(("curve", one) for one in OF_A_CURVE),
    *(("friction", one) for one in OF_FRICTION)])
def test_a_column_is_drawn_with_its_words_and_its_unit(scene_of, scene, quantity):
    where, parameters = scene_of[scene]
    study = wb.study(where, parameters, quantity=quantity)
    assert study.converged and quantity in study.table
    labels = re.findall(r"<tspan[^>]*>([^<]*)<", study.svg())
    assert label_of(quantity) in labels


def test_what_is_measured_of_a_motion_is_missing_without_one_and_its_effort_is_not(bar_text):
    # The first of the two runs has too few periods to converge.
    stepping = bar_text[:bar_text.index("[time]")] + '[analysis]\ntype = "time_stepping"\n'
    table = wb.study(stepping, {"analysis.max_periods": [1, 2000]}).table
    assert table["status"] == ["iteration_limit", "converged"]
    for result in ("max_displacement_m", "contact_fraction"):
        np.testing.assert_array_equal(np.isnan(table[result]), [True, False])
    for kept in ("iterations", "unknowns", "frequency_Hz", "degrees_of_freedom"):  # diagnostics and settings
        assert np.all(np.isfinite(table[kept])), kept
    for heading in ("wall_seconds", "solve_seconds", "analysis"):
        assert heading in wb.run(stepping).summary and heading not in table


def test_the_residual_of_a_response_that_does_not_converge_is_kept(bar_text):
    # Beside its natural frequency an undamped bar of one element is solved, but rounding leaves nothing of its motion.
    undamped = ["structure.stiffness_damping=0", "structure.elements=1", "contact.law=none"]
    natural = np.sqrt(3.0 * 70e9 / 2700.0) / (2.0 * np.pi)
    table = wb.study(bar_text, {"forcing.frequency": [natural * (1.0 + 1e-13), 150.0]}, undamped,
                     unset=["contact.constant", "contact.exponent", "contact.gap"]).table
    np.testing.assert_array_equal(table["converged"], [False, True])
    assert np.all(np.isfinite(table["residual"]))
    np.testing.assert_array_equal(np.isnan(table["max_displacement_m"]), [True, False])
