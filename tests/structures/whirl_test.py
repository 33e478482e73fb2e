"""Whirl frequencies of a rotor with their direction, critical speeds, the Campbell diagram, and orbits."""

import csv
import re

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
from overhung_disk import DAMPING, GYROSCOPIC, MASS, ROTOR, STIFFNESS, plane, whirl

import wavebalance as wb

pytestmark = pytest.mark.usefixtures("rotor_files")

SWEEP = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 30.0, "analysis.frequency_to": 80.0,
         "analysis.stability": False, "analysis.phases": False}
TWO_PI = 2.0 * np.pi


def written(tmp_path, overrides=None, scene=ROTOR, name="out"):
    """The record and a csv file of its folder as columns."""
    record = wb.run(scene, overrides, output=tmp_path / name)
    assert record.converged, record.status

    def columns(file):
        with open(tmp_path / name / file, newline="") as text:
            rows = list(csv.DictReader(text))
        return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}

    return record, columns


def quadratic(stiffness, damping, mass):
    """All exponents of x'' M + x' C + x K = 0 and their shapes."""
    size = len(mass)
    first = np.block([[np.zeros((size, size)), np.eye(size)], [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)]])
    values, vectors = np.linalg.eig(first)
    return values, vectors[:size]


def roots(speed, spin_stiffness=0.0):
    """The four exponents of x + iy and its rotation: forwards with a positive imaginary part."""
    return quadratic(*plane(speed, spin_stiffness))[0]


def lines_at(table, row):
    """Frequency, damping ratio and circularity of each line at one speed, by the frequency."""
    count = sum(name.endswith("_circularity") for name in table)
    lines = [[table[f"whirl_{k}_{what}"][row] for what in ("frequency_Hz", "damping_ratio", "circularity")]
             for k in range(1, count + 1)]
    return np.array(sorted(lines))


@pytest.mark.parametrize("keys, spin_stiffness", [
    ({}, 0.0), ({"structure.spin_stiffness": "s.mtx"}, 1.0), ({"structure.spin_speed": 200.0}, 0.0), ({"structure.kept_modes": 2}, 0.0)])
def test_the_campbell_diagram_has_the_four_roots_of_an_overhung_disk(tmp_path, keys, spin_stiffness):
    _, columns = written(tmp_path, {**SWEEP, **keys})
    table = columns("campbell.csv")
    assert table["speed_Hz"][0] == 0.0 and table["speed_Hz"][-1] == pytest.approx(80.0)
    for row in range(1, len(table["speed_Hz"])):
        exact = roots(TWO_PI * table["speed_Hz"][row], spin_stiffness)
        exact = exact[np.argsort(np.abs(exact.imag))]
        found = lines_at(table, row)
        np.testing.assert_allclose(found[:, 0], np.abs(exact.imag) / TWO_PI, rtol=1e-10)
        np.testing.assert_allclose(found[:, 1], -exact.real / np.abs(exact), rtol=1e-7)
        np.testing.assert_allclose(found[:, 2], np.sign(exact.imag), rtol=1e-9)


def test_a_line_is_one_whirl_from_rest_to_the_highest_speed(tmp_path):
    table = written(tmp_path, SWEEP)[1]("campbell.csv")
    for k in range(1, 5):
        assert len(set(np.sign(table[f"whirl_{k}_circularity"][1:]))) == 1
        assert np.max(np.abs(np.diff(table[f"whirl_{k}_frequency_Hz"], 2))) < 0.05 * np.ptp(table["whirl_4_frequency_Hz"]) + 0.5


def test_critical_speeds_are_where_a_root_has_the_frequency_of_the_speed(tmp_path):
    record, _ = written(tmp_path, SWEEP)
    found = record.summary["critical_speeds"]

    def off(speed, sense):
        """Difference of the lowest whirl of one sense from the speed."""
        values = sense * roots(speed).imag
        return np.min(values[values > 1.0]) - speed

    exact = {sense: scipy.optimize.brentq(off, 100.0, 400.0, args=(sense,), xtol=1e-11) / TWO_PI for sense in (-1.0, 1.0)}
    assert list(found["direction"]) == ["backward", "forward"]
    np.testing.assert_allclose(found["speed_Hz"], [exact[-1.0], exact[1.0]], rtol=1e-11)
    np.testing.assert_allclose(found["circularity"], [-1.0, 1.0], rtol=1e-9)


def test_an_unbalance_that_turns_the_other_way_exchanges_the_directions(tmp_path):
    record, _ = written(tmp_path, SWEEP, ROTOR.replace("[1, 2]", "[1, -2]"))
    assert list(record.summary["critical_speeds"]["direction"]) == ["forward", "backward"]
    assert any("turns against structure.gyroscopic" in warning for warning in record.warnings)
    assert not any("gyroscopic" in warning for warning in written(tmp_path, SWEEP, name="along")[0].warnings)
    assert "turns against structure.gyroscopic" in wb.check(ROTOR.replace("[1, 2]", "[1, -2]"))


def test_bearings_of_two_stiffnesses_make_ellipses_of_their_circularity(tmp_path, rotor_files):
    stiffness = STIFFNESS.copy()
    stiffness[1, 1] *= 1.3
    rotor_files("k.mtx", stiffness.tolist())
    table = written(tmp_path, SWEEP)[1]("campbell.csv")
    for row in (10, 40):
        values, shapes = quadratic(stiffness, DAMPING + TWO_PI * table["speed_Hz"][row] * GYROSCOPIC, MASS)
        upper = np.flatnonzero(values.imag > 0.0)
        upper = upper[np.argsort(values[upper].imag)]
        x, y = shapes[0, upper], shapes[1, upper]
        found = lines_at(table, row)
        np.testing.assert_allclose(found[:, 0], values[upper].imag / TWO_PI, rtol=1e-10)
        expected = 2.0 * np.imag(x * np.conj(y)) / (np.abs(x)**2 + np.abs(y)**2)
        np.testing.assert_allclose(found[:, 2], expected, rtol=1e-6, atol=1e-9)
        assert np.min(np.abs(expected)) < 0.6


def test_check_says_the_whirls_at_the_speed_and_the_critical_speeds():
    text = wb.check(ROTOR)
    line = re.search(r"whirl +at 251.3274 rad/s: (.*)", text)[1]
    found = re.findall(r"([\d.]+) Hz (forward|backward) \(([\d.]+) %\)", line)
    exact = roots(80.0 * np.pi)
    exact = exact[np.argsort(np.abs(exact.imag))]
    np.testing.assert_allclose([float(one[0]) for one in found], np.abs(exact.imag) / TWO_PI, rtol=5e-5)
    assert [one[1] for one in found] == ["forward" if one.imag > 0.0 else "backward" for one in exact]
    assert re.search(r"critical +37\.703 Hz backward .*40\.826 Hz forward .*up to 80 Hz", text)


def test_the_orbit_of_a_response_is_the_circle_of_its_whirl(tmp_path):
    record, columns = written(tmp_path)
    orbit = columns("orbits.csv")
    radius = abs(whirl(40.0, 80.0 * np.pi))
    np.testing.assert_allclose(np.hypot(orbit["x_m"], orbit["y_m"]), radius, rtol=1e-9)
    turned = np.unwrap(np.arctan2(orbit["y_m"], orbit["x_m"]))
    np.testing.assert_allclose(turned - turned[0], TWO_PI * orbit["time_fraction"], atol=1e-9)
    assert (tmp_path / "out" / "orbits.svg").exists() and "orbits" in (tmp_path / "out" / "report.html").read_text()


def test_orbits_of_points_of_a_curve_have_the_radius_at_their_speed(tmp_path):
    _, columns = written(tmp_path, {**SWEEP, "analysis.motion_at": [35.0, 70.0]})
    orbits = columns("orbits.csv")
    for k, frequency in ((1, 35.0), (2, 70.0)):
        radius = np.hypot(orbits[f"motion_{k}_x_m"], orbits[f"motion_{k}_y_m"])
        np.testing.assert_allclose(radius, abs(whirl(frequency, TWO_PI * frequency)), rtol=1e-8)


RING = """
[[contact.pairs]]
law = "ring"
stiffness = 5e6
gap = 2e-4
dofs = [1]
tangent = [2]
"""


def test_the_orbit_in_a_ring_goes_beyond_its_clearance_by_the_force(tmp_path):
    scene = ROTOR.replace("contact_dofs = [1]\n", "").replace('[contact]\nlaw = "none"\n', RING)
    record, columns = written(tmp_path, {"forcing.frequency": 30.0}, scene)
    orbit = columns("orbits.csv")
    radius = np.hypot(orbit["x_m"], orbit["y_m"])
    assert np.ptp(radius) < 1e-9 * np.max(radius)
    assert record.summary["max_contact_force_N"] == pytest.approx(5e6 * (radius[0] - 2e-4), rel=1e-9)
