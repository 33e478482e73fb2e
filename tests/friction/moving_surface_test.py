"""Friction against a surface that moves, with a coefficient at rest above the one of slip, and with dashpots parallel
to its springs."""

import csv
import functools

import numpy as np
import pytest
from friction_by_events import OPEN, RELEASED, FrictionFlow

import wavebalance as wb

ONE = {"mass": np.diag([1.0]), "damping": np.array([[0.1]]), "stiffness": np.array([[4.0]])}
TWO = {"mass": np.diag([1.0, 0.5]), "damping": np.array([[0.3, -0.05], [-0.05, 0.2]]), "stiffness": np.array([[8.0, -2.0], [-2.0, 6.0]])}


LOADS = {"one": ([0.8], 0.3), "two": ([0.9, 0.4], 0.37)}


CASES = {
    "rigid against a belt": ("one", None, {"surface_speed": 0.1}),
    "rigid with static friction": ("one", None, {"surface_speed": 0.15, "static_friction": 0.5}),
    "rigid with static friction and no belt": ("one", None, {"static_friction": 0.35}),
    "elastic against a belt": ("two", None, {"surface_speed": 0.2, "tangential_stiffness": 40.0}),
    "elastic with static friction": ("one", None, {"surface_speed": 0.3, "static_friction": 0.5, "tangential_stiffness": 50.0}),
    "a dashpot beside the spring": ("one", None, {"tangential_stiffness": 50.0, "tangential_damping": 0.5}),
    "all of these": ("two", None, {"surface_speed": 0.2, "static_friction": 0.4, "tangential_stiffness": 40.0,
                                   "tangential_damping": 0.8}),
    "a normal dashpot that lifts off": ("two", 1, {"tangential_stiffness": 40.0, "normal_stiffness": 30.0, "normal_damping": 0.6,
                                                   "normal_load": 0.1}),
    "all with a normal that lifts off": ("two", 1, {"surface_speed": 0.1, "static_friction": 0.4, "tangential_stiffness": 40.0,
                                                    "tangential_damping": 0.8, "normal_stiffness": 30.0, "normal_damping": 0.6,
                                                    "normal_load": 0.1}),
}


def solve(folder, structure, contact, load, frequency, analysis="forced_response", normal=None, output_points=4096):
    pair = {"law": "coulomb", "dofs": [1]} if normal is None else {"law": "coulomb", "dofs": [normal + 1], "tangent": [1]}
    terms = [{"dofs": [i + 1], "amplitude": one} for i, one in enumerate(load)]
    scene = {"structure": {"type": "matrices"} | structure, "contact": {"pairs": [pair | contact]},
             "forcing": {"frequency": frequency, "terms": terms},
             "analysis": {"type": analysis, "output_points": output_points}}
    record = wb.run(scene, output=folder / "out")
    with open(folder / "out" / "friction.csv") as file:
        u = np.array([float(row["displacement_m"]) for row in csv.DictReader(file)])
    return record.summary, u


def case(name):
    """The arguments of solve() and settled()."""
    size, normal, more = CASES[name]
    load, frequency = LOADS[size]
    contact = {"friction": 0.3, "normal_load": 2.0 if size == "one" else 1.0} | more
    return {"structure": ONE if size == "one" else TWO, "contact": contact, "load": load, "frequency": frequency, "normal": normal}


@functools.cache
def settled(name):
    """The motion after transients by the integration of the tests: its flow, the state at its beginning, and its parts."""
    structure, contact, load, frequency, normal = case(name).values()
    flow = FrictionFlow(**structure, load=np.array(load), frequency=frequency, contact=contact, tangent=0, normal=normal)
    y, state = np.zeros(2 * flow.size + 1), 0
    if flow.rigid and contact.get("surface_speed", 0.0) != 0.0:
        state = -1
    for _ in range(200):
        before, begin = y, state
        y, state, parts = flow.period(y, state)
        if state == begin and np.abs(y - before)[:-1].max() < 3e-12:
            return flow, state, y, parts
    raise AssertionError("the integration does not settle")


@pytest.mark.parametrize("more", [{}, {"tangential_stiffness": 50.0}, {"tangential_stiffness": 50.0, "tangential_damping": 0.5}])
@pytest.mark.parametrize("analysis", ["forced_response", "time_stepping"])
def test_against_a_fast_surface_friction_is_a_constant_force(tmp_path, more, analysis):
    # u = mu N / k + F H cos(w t + phase); the surface does mu N V T of work and the slider slips V T.
    contact = {"friction": 0.3, "normal_load": 2.0, "surface_speed": 3.0, "wear_coefficient": 1e-3} | more
    load, frequency = [0.5], 0.2
    summary, u = solve(tmp_path, ONE, contact, load, frequency, analysis)
    w = 2.0 * np.pi * frequency
    times = np.arange(len(u)) / len(u) / frequency
    expected = 0.6 / 4.0 + (0.5 / (4.0 - w**2 + 0.1j * w) * np.exp(1j * w * times)).real
    assert u == pytest.approx(expected, abs=1e-9)
    assert summary["friction_work_J"] == pytest.approx(0.6 * 3.0 / frequency, rel=1e-9)
    assert summary["friction"]["slip_m"][0] == pytest.approx(3.0 / frequency, rel=1e-9)
    assert summary["wear_m3"] == pytest.approx(1e-3 * 2.0 * 3.0 / frequency, rel=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_that_of_another_integration(tmp_path, name):
    flow, _, y, parts = settled(name)
    share = {kind: sum(times[-1] - times[0] for times, _, one in parts if one in of) * LOADS[CASES[name][0]][1]
             for kind, of in (("stick", (0,)), ("slip", (1, -1)), ("open", (OPEN, RELEASED)))}
    for analysis in ("forced_response", "time_stepping"):
        summary, u = solve(tmp_path, **case(name), analysis=analysis)
        assert summary["status"] == "converged"
        assert u[0] == pytest.approx(y[0], abs=1e-9)
        table = summary["friction"]
        for kind, expected in share.items():
            assert table[f"{kind}_fraction"][0] == pytest.approx(expected, abs=1e-9)
        assert table["slip_m"][0] == pytest.approx(flow.slip, rel=1e-8)


@pytest.mark.parametrize("name", ["rigid with static friction and no belt", "elastic against a belt", "a dashpot beside the spring",
                                  "all of these", "all with a normal that lifts off"])
def test_multipliers_are_those_of_the_map_of_another_integration(tmp_path, name):
    flow, state, y, _ = settled(name)
    summary, _ = solve(tmp_path, **case(name))
    remembers = (state == 0 and not flow.rigid) or (state in (1, -1) and flow.damped)
    kept = np.arange(2 * flow.size + remembers)

    def after(z):
        start = y.copy()
        start[kept] = z
        end, last, _ = flow.period(start, state)
        assert last == state
        return end[kept]

    step = 1e-5
    moved = [after(y[kept] + step * one) - after(y[kept] - step * one) for one in np.eye(len(kept))]
    multipliers = np.linalg.eigvals(np.array(moved).T / (2.0 * step))
    largest = multipliers[np.argmax(np.abs(multipliers))]
    found = complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])
    assert abs(found) == pytest.approx(abs(largest), abs=1e-7)  # the differences' error, 1e-12 over the step


def test_a_curve_of_exact_motions_meets_the_motions_at_its_frequencies(tmp_path):
    one = case("all of these")
    curve = wb.run({"structure": {"type": "matrices"} | one["structure"],
                    "contact": {"pairs": [{"law": "coulomb", "dofs": [1]} | one["contact"]]},
                    "forcing": {"terms": [{"dofs": [i + 1], "amplitude": load} for i, load in enumerate(one["load"])]},
                    "analysis": {"type": "frequency_sweep", "frequency_from": 0.33, "frequency_to": 0.4}}, output=tmp_path / "curve")
    assert curve.converged and curve.summary["solved_by"] == "exact"
    with open(tmp_path / "curve" / "sweep.csv") as file:
        points = list(csv.DictReader(file))
    for point in (points[0], points[len(points) // 2], points[-1]):
        summary, _ = solve(tmp_path, **one | {"frequency": float(point["frequency_Hz"])})
        assert float(point["max_displacement_m"]) == pytest.approx(summary["max_displacement_m"], rel=1e-5)  # of samples
        assert float(point["friction_work_J"]) == pytest.approx(summary["friction_work_J"], rel=1e-8)


@pytest.mark.parametrize("more, expected", [
    ({"static_friction": 0.2}, "static_friction = 0.2: expected at least friction = 0.3"),
    ({"tangential_damping": 1.0}, "tangential_damping = 1.0: not without contact.tangential_stiffness"),
    ({"tangential_stiffness": 9.0, "normal_damping": 1.0}, "normal_damping = 1.0: the contact has no normal direction"),
    ({"surface_speed": float("nan")}, "surface_speed = nan: expected a number in m/s; it must be finite"),
    ({"tangential_stiffness": 9.0, "tangential_damping": -1.0}, "tangential_damping = -1.0: out of range; expected a number in N s/m, >= 0"),
])
def test_what_makes_no_law_is_refused_by_its_key(tmp_path, more, expected):
    with pytest.raises(ValueError) as error:
        solve(tmp_path, ONE, {"friction": 0.3, "normal_load": 2.0} | more, *LOADS["one"])
    assert f"contact.pairs[1].{expected}" in str(error.value)
    assert not (tmp_path / "out").exists()


def test_functions_that_would_have_no_part_are_refused(tmp_path):
    contact = {"friction": 0.3, "normal_load": 2.0, "surface_speed": 0.1}
    scene = {"structure": {"type": "matrices"} | ONE, "contact": {"pairs": [{"law": "coulomb", "dofs": [1]} | contact]},
             "forcing": {"load_dofs": [1], "amplitude": 0.8, "frequency": 0.3}, "analysis": {"type": "forced_response"},
             "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 128}}
    with pytest.raises(ValueError, match="time.trial = \"fourier\": not with friction of surface_speed"):
        wb.run(scene)
    with pytest.raises(ValueError, match="friction with surface_speed, .* without bases to compare"):
        wb.compare(scene | {"time": {}})


def test_two_tangents_and_modes_are_refused(tmp_path):
    belt = {"law": "coulomb", "friction": 0.3, "tangential_stiffness": 9.0, "surface_speed": 0.1, "normal_stiffness": 5.0}
    structure = {"type": "matrices", "mass": np.eye(3), "stiffness": 4.0 * np.eye(3)}
    scene = {"structure": structure, "contact": {"pairs": [{"dofs": [3], "tangent": [1], "second_tangent": [2]} | belt]},
             "forcing": {"load_dofs": [1], "amplitude": 1.0, "frequency": 0.3}, "analysis": {"type": "forced_response"}}
    with pytest.raises(ValueError, match=r"contact\.pairs\[1\]\.surface_speed = 0.1: not with two tangents"):
        wb.run(scene)
    scene["contact"] = {"pairs": [{"dofs": [3], "tangent": [1]} | belt]}
    del scene["forcing"]
    scene["analysis"] = {"type": "nonlinear_mode"}
    with pytest.raises(ValueError, match="not with contact.surface_speed"):
        wb.run(scene)


def test_in_time_few_output_points_are_enough(tmp_path):
    summary, u = solve(tmp_path, **case("elastic with static friction"), analysis="time_stepping", output_points=16)
    assert summary["status"] == "converged"
    assert len(u) == 16
