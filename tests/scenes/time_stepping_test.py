"""Time integration converges to periodic motions to the requested tolerance."""

import numpy as np
import pytest

import wavebalance as wb

DAMPER = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
free = true
[contact]
law = "kelvin_voigt"
stiffness = 500.0
damping = 1.6
gap = 1.0
[[contact.pairs]]
dofs = [2, 1]
side = "both"
[forcing]
load_dofs = [1]
amplitude = 0.06
frequency = 0.15915494309189535
[analysis]
type = "time_stepping"
"""


@pytest.fixture
def files(matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.05]])
    matrix("k.mtx", [[1.0, 0.0], [0.0, 0.0]])
    matrix("c.mtx", [[0.02, 0.0], [0.0, 0.0]])


@pytest.mark.parametrize("depth, tolerance", [(0.0, 1e-7), (1e-4, 1e-7), (1e-3, 1e-7), (1e-3, 1e-9), (1e-2, 1e-7)])
def test_a_free_ball_between_dashpots_settles_to_its_periodic_motion(run, files, depth, tolerance):
    record = run(DAMPER, set=[f"contact.damping_depth={depth}", f"analysis.tolerance={tolerance}"])
    assert record.code == 0, record.errors
    assert record.summary["status"] == "converged"
    assert record.summary["attractor_periods"] == 1
    assert record.summary["residual"] <= tolerance
    assert not record.summary["warnings"]


def test_a_tolerance_below_the_error_of_steps_is_missed_and_not_aperiodic(run, files):
    record = run(DAMPER, set=["contact.damping_depth=1e-3", "analysis.tolerance=1e-15", "analysis.max_periods=400"])
    assert record.code == 3
    assert record.summary["status"] == "tolerance_missed"
    assert "attractor_periods" not in record.summary
    assert not [warning for warning in record.summary["warnings"] if "aperiodic" in warning]


def test_too_few_periods_say_nothing_of_the_load(run, files):
    record = run(DAMPER, set=["analysis.max_periods=3"])
    assert record.summary["status"] == "iteration_limit"
    assert not [warning for warning in record.summary["warnings"] if "static load" in warning]


def test_impacts_that_come_to_one_period_by_turns_repeat_after_one(run, scenes):
    """A multiplier near -0.6: the last state is nearer to the last but one than to that before it."""
    record = run(scenes / "impacts" / "oscillator.toml", "--analysis", "time_stepping")
    assert record.code == 0, record.errors
    assert record.summary.get("period_of_motion", 1) == 1
    assert record.summary["impacts"] == 1


@pytest.mark.parametrize(("damping", "tolerance"), [(20.0, 1e-11), (1000.0, 1e-12)])
def test_a_damper_that_sets_in_at_once_is_stepped_to_any_tolerance(run, structure, damping, tolerance):
    """Across the jump of its force steps are as short as rounding of the time lets them be."""
    record = run(structure(1.0, 1.0, 0.02) + f"""contact_dofs = [1]
[contact]
law = "kelvin_voigt"
stiffness = 200.0
damping = {damping}
gap = 0.5
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.17
[analysis]
type = "time_stepping"
tolerance = {tolerance}
""")
    assert record.summary["status"] == "converged"


def stepped(damping, load, omega, contact=None, **analysis):
    """A mass of 1 kg on a spring of 1 N/m under load cos(omega t)."""
    return wb.run({
        "structure": {"type": "matrices", "mass": np.eye(1), "stiffness": np.eye(1), "damping": damping * np.eye(1)},
        "contact": {"law": "linear", "stiffness": 1.0, "gap": 1e9} | (contact or {}) | {"pairs": [{"dofs": [1]}]},
        "forcing": {"load_dofs": [1], "amplitude": load, "frequency": omega / (2.0 * np.pi)},
        "analysis": {"type": "time_stepping"} | analysis})


def test_without_contact_it_is_the_closed_form():
    record = stepped(0.1, 0.8, 1.3, tolerance=1e-9, output_points=64)
    amplitude = 0.8 / (1.0 - 1.3**2 + 0.13j)
    turns = np.exp(2j * np.pi * np.arange(64) / 64)
    assert record.converged
    assert record.response["displacement_m"] == pytest.approx((amplitude * turns).real, abs=1e-8)
    assert record.response["velocity_m_per_s"] == pytest.approx((1.3j * amplitude * turns).real, abs=1e-8)
    assert not np.any(record.response["contact_force_N"])


@pytest.mark.parametrize("stiffness, gap, load, omega, tolerance, periods", [
    (10.0, 0.1, 0.8, 2.7, 1e-7, 2), (10.0, 0.1, 0.8, 2.4, 1e-7, 4),  # between its period doublings
    (100.0, 0.0, 1.0, 2.4, 1e-6, 3),  # successive periods differ by three values in turn
])
def test_subharmonic_motions_name_their_periods(stiffness, gap, load, omega, tolerance, periods):
    record = stepped(0.1, load, omega, {"stiffness": stiffness, "gap": gap}, tolerance=tolerance)
    assert record.status == "subharmonic"
    assert record.summary["attractor_periods"] == periods
    assert record.summary["residual"] > 0.1


def test_a_transient_that_alternates_as_it_decays_is_no_subharmonic_motion():
    """Driven at twice its natural frequency: a multiplier of -0.995."""
    record = stepped(0.0032, 0.8, 2.0, tolerance=1e-4)
    assert record.status == "converged"
    assert record.summary["attractor_periods"] == 1


def test_damping_that_a_stop_limits_may_be_negative():
    record = stepped(-0.02, 0.5, 0.9, {"law": "kelvin_voigt", "stiffness": 5.0, "damping": 1.0, "gap": 0.5,
                                       "damping_depth": 0.0})
    assert record.status == "converged"
    assert record.summary["contact_fraction"] > 0.1
    assert abs(complex(record.summary["leading_multiplier_real"], record.summary["leading_multiplier_imag"])) < 1.0
