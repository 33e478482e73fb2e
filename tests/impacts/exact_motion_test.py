"""Exact motions with friction, time.method = "exact": event-driven integrations, forces of the law, closed forms."""

import math

import numpy as np
import pytest
import wavebalance as wb
from friction_structures import ROWS, chain, lift_off, masses, jenkins

FIRST_SLIP = 1.7976408151  # the load (L / k_t) |1 + k_t - omega^2 + i c omega| at omega = 0.45


def solve(given, points=1024, **analysis):
    record = wb.run({**given, "analysis": {"type": "forced_response", "output_points": points, **analysis}})
    assert record.converged, record.status
    return record


def first_harmonic(samples):
    """2/T times the integral of u exp(i omega t)."""
    return 2.0 / len(samples) * np.exp(2j * math.pi * np.arange(len(samples)) / len(samples)) @ samples


@pytest.mark.parametrize("name", ROWS)
def test_a_motion_has_the_harmonic_the_work_and_the_multipliers_of_the_exact_one(name):
    given, amplitude, degrees, work, largest, second = ROWS[name]
    compared = 3 if name.startswith("beam") else 1  # the degree of freedom
    record = solve(given, 16384, outputs=[compared])
    summary, digits = record.summary, 1e-8 if largest is None else 1e-9
    assert summary["solved_by"] == "exact" and summary["phases_unknowns"] <= 400
    exact = amplitude * np.exp(1j * math.radians(degrees))
    assert abs(first_harmonic(record.outputs[f"row_{compared}_m"]) - exact) <= digits * amplitude
    assert summary["friction_work_J"] == pytest.approx(work, rel=digits, abs=0.0)
    assert summary["unstable_multipliers"] == 0
    if largest is None:  # not known
        return
    # The last digit of the beams' rows comes from matrix exponentials with fast poles.
    allowed = 2e-8 if name.startswith("beam") else 1e-8
    leading = complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])
    assert abs(leading) == pytest.approx(largest, abs=allowed, rel=0.0)
    if leading.imag != 0.0:  # one of a pair
        assert abs(leading) == pytest.approx(second, abs=allowed, rel=0.0)


def test_slip_lift_off_and_landing_are_at_the_instants_of_the_exact_motion():
    record = solve(lift_off(2.0, 2.0, 0.6, 0.5, 3.0))
    summary = record.summary
    (_, tangential), times = rows_of(record)[1], np.arange(1024) / 1024.0
    assert (tangential[(times > 0.280840393) & (times < 0.299434949)] < 0.0).all()  # it slips backward
    assert list(summary["phases"]["state"]) == ["slip", "open", "stick"]
    begins = [0.280840393, 0.299434949, 0.951154093]
    assert list(summary["phases"]["begin"]) == pytest.approx(begins, abs=1e-9, rel=0.0)
    shares = [summary["friction"][f"{state}_fraction"][0] for state in ("stick", "slip", "open")]
    assert shares == pytest.approx([0.3296863, 0.018594557, 0.651719143], abs=1e-8, rel=0.0)


def force_of_law(pair, tangential, normal=None):
    """Coulomb's law along samples of a periodic motion, of second order."""
    raw = np.full(len(tangential), pair["normal_load"])
    if normal is not None:
        raw = pair["normal_load"] + pair["normal_stiffness"] * normal
    limit, before = np.maximum(raw, 0.0), np.roll(raw, 1)
    lands = (before < 0.0) & (raw > 0.0)
    closed = np.divide(raw, raw - before, out=np.ones_like(raw), where=lands)  # the part of a step after landing
    bound = pair["friction"] * limit
    steps = closed * pair["tangential_stiffness"] * np.diff(tangential, prepend=tangential[-1])
    force, now = np.empty(len(bound)), 0.0
    for _ in range(2):
        for k in range(len(bound)):
            now = force[k] = min(max(now + steps[k], -bound[k]), bound[k])
    return force, limit


def rows_of(record):
    """Displacements and forces along the contacts' directions, a row each."""
    table = record.contacts
    if not table:
        return record.response["displacement_m"][None], record.response["contact_force_N"][None]
    points = len(set(table["time_fraction"]))
    return tuple(table[key].reshape(points, -1).T for key in ("displacement_m", "contact_force_N"))


def test_a_lifting_contact_has_the_forces_of_its_law():
    given = lift_off(1.0, 1.0, 0.6, 0.5, 2.4)
    (pair,), (u, force) = given["contact"]["pairs"], rows_of(solve(given, 1 << 15))
    tangential, normal = force_of_law(pair, u[1], u[0])
    assert np.linalg.norm(np.array([normal, tangential]) - force) <= 1e-7 * np.linalg.norm(force)


def test_sliders_of_a_chain_have_the_forces_of_their_law():
    given = chain(3.0, 0.85)
    u, force = rows_of(solve(given, 1 << 15))
    expected = np.array([force_of_law(pair, row)[0] for pair, row in zip(given["contact"]["pairs"], u)])
    assert np.linalg.norm(expected - force) <= 1e-7 * np.linalg.norm(force)


def test_a_contact_that_sticks_always_has_the_motion_with_its_spring():
    given, omega = masses(1.0, 2.0, 100.0, 1.1), 1.1
    record = solve(given, 64)
    parts = given["structure"]
    impedance = parts["stiffness"] + 1j * omega * parts["damping"] - omega**2 * np.eye(2) + np.diag([2.0, 0.0])
    exact = np.linalg.solve(impedance, [0.0, 1.0])[0]
    assert abs(first_harmonic(record.response["displacement_m"]) - exact.conjugate()) <= 1e-11 * abs(exact)
    assert record.summary["friction"]["stick_fraction"][0] == 1.0
    assert abs(complex(record.summary["leading_multiplier_real"], record.summary["leading_multiplier_imag"])) <= 1.0


def test_a_slider_sticks_below_the_load_at_which_slip_begins():
    summary = solve(jenkins(0.9999 * FIRST_SLIP, 1.0, 0.45)).summary
    assert summary["friction"]["stick_fraction"][0] == 1.0


@pytest.mark.parametrize("above", [1e-2, 1e-3, 1e-4])
def test_a_slider_slips_just_above_the_load_at_which_slip_begins(above):
    summary = solve(jenkins((1.0 + above) * FIRST_SLIP, 1.0, 0.45)).summary
    assert len(summary["phases"]["state"]) == 4
    assert 0.0 < summary["friction_work_J"] <= 10.0 * above


def test_a_coefficient_of_friction_of_zero_has_the_motion_without_friction():
    given = lift_off(2.0, 2.0, 0.6, 0.5, 3.0)
    given["contact"]["pairs"][0]["friction"] = 0.0
    u, _ = rows_of(solve(given, 128))
    apart = lift_off(2.0, 2.0, 0.6, 0.5, 3.0)
    apart["contact"] = {"law": "linear", "pairs": [{"dofs": [2], "stiffness": 21.0, "gap": -0.6 / 21.0}]}
    exact = solve(apart, 128, outputs=[1, 2]).outputs
    expected = np.array([exact["row_2_m"], exact["row_1_m"]])
    assert np.linalg.norm(u - expected) <= 1e-9 * np.linalg.norm(expected)
