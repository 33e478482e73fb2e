"""Directions of a dof map, weights, loads of single terms, and the static deflection of a structure."""

import tomllib

import numpy as np
import pytest
from structure_scenes import CHAIN, CHAIN_STIFFNESS, changed, displacements, distance, refused, solved, terms

import wavebalance as wb

MAPPED = changed(CHAIN, ("modal_damping = 0.01", 'dof_map = "chain.dof"\nmodal_damping = 0.01'),
                 ("amplitude = 100.0", "amplitude = 0.0"))
BASE = 'kind = "base_acceleration"\namplitude = 30.0\n'
VIBRATES = "amplitude = 5.0\ndofs = [1]"
LINEAR = {"contact.law": "none"}, ["contact.stiffness", "contact.gap"]
FAR = {"structure.contact_dofs": [1, 2, 3], "contact.gap": 1.0}


@pytest.fixture(autouse=True)
def mapped_chain(chain_files, matrix):
    (chain_files / "chain.dof").write_text("7.3\n20.3\n4.1\n")  # z, z and x
    matrix("g.mtx", [[0.5], [0.0], [-2.0]])
    matrix("short.mtx", [[1.0], [1.0]])
    return chain_files


def loaded(lines):
    return changed(MAPPED, ("[time]", lines + "\n[time]"))


def rest_of(scene, overrides=None, unset=()):
    record = wb.run(scene, {"analysis.phases": False, "time.functions": 7, **(overrides or {})}, unset=unset)
    assert "rest_status" not in record.summary
    return record.summary["at_rest"]


@pytest.mark.parametrize("weight, force", [
    ("weight = [0, 0, -9.81]", [-19.62, -19.62, 0.0]),
    ("weight = [3.0, 0, -9.81]", [-19.62, -19.62, 6.0]),
])
def test_the_weight_is_the_masses_times_the_acceleration_along_their_rows(weight, force):
    found = rest_of(loaded(weight + "\n" + terms(VIBRATES)), FAR)["displacement_m"]
    assert distance(found, np.linalg.solve(CHAIN_STIFFNESS, force)) < 1e-14
    assert distance(CHAIN_STIFFNESS @ found, np.array(force)) < 1e-14


def test_a_base_that_shakes_along_a_direction_shakes_the_rows_that_point_there():
    rows, along, against = (displacements(solved(loaded(terms(BASE + where)), *LINEAR))
                            for where in ("dofs = [1, 2]", 'direction = "z"', 'direction = "-z"'))
    assert distance(along, rows) <= 1e-15
    assert distance(against, -rows) <= 1e-15


def test_each_term_takes_a_load_vector():
    for_each = loaded(terms('harmonic = 0\namplitude = 4.0\nload = "g.mtx"', VIBRATES))
    found = rest_of(for_each, FAR)["displacement_m"]
    assert distance(CHAIN_STIFFNESS @ found, np.array([2.0, 0.0, -8.0])) <= 1e-15
    vector, rows = (displacements(solved(loaded(terms(*each)), *LINEAR)) for each in (
        ['amplitude = 4.0\nload = "g.mtx"'], ["amplitude = 2.0\ndofs = [1]", "amplitude = -8.0\ndofs = [3]"]))
    assert distance(vector, rows) <= 1e-15


def test_a_reduction_keeps_the_rows_of_point_loads_beside_a_load_on_many_rows(matrix):
    stiffness = 1e6 * (2.0 * np.eye(40) - np.eye(40, k=1) - np.eye(40, k=-1))
    stiffness[-1, -1] = 1e6
    matrix("k.mtx", stiffness.tolist())
    matrix("m.mtx", (2.0 * np.eye(40)).tolist())
    matrix("many.mtx", [[1.0]] * 40)
    loads = terms('harmonic = 0\namplitude = 1.0\nload = "many.mtx"', "dofs = [17]\namplitude = 1.0")
    said = wb.check(changed(CHAIN, ("amplitude = 100.0", "amplitude = 0.0")) + loads, {"structure.kept_modes": 5})
    assert f"reduced to {3 + 5} (5 modes)" in said  # rows 2, 3 and 17, and the modes


STANDS = loaded(terms("harmonic = 0\namplitude = 300.0\ndofs = [3]", VIBRATES))
ONE_FAR = {"contact.gap": [1.0, 1e-4]}


def test_it_stands_under_its_static_loads_with_the_contacts_that_they_close():
    # K u + k (u_3 - g) e_3 = f where only the last mass touches.
    closed = CHAIN_STIFFNESS + np.diag([0.0, 0.0, 1e7])
    u = np.linalg.solve(closed, [0.0, 0.0, 300.0 + 1e7 * 1e-4])
    rest = rest_of(STANDS, ONE_FAR)
    assert distance(rest["displacement_m"], u[1:]) < 1e-10
    assert rest["contact_force_N"][1] == pytest.approx(1e7 * (u[2] - 1e-4), rel=1e-8)
    assert rest["contact_force_N"][0] == 0.0
    said = wb.check(STANDS, ONE_FAR)
    assert "at rest    1 of 2 contacts is closed under the static loads" in said
    for displacement in u[1:]:
        assert f": {1e6 * displacement:.4g} µm, " in said
    assert f"{1e7 * (u[2] - 1e-4):.4g} N\n" in said


def test_it_stands_on_a_rigid_obstacle():
    rest = rest_of(STANDS, {**ONE_FAR, "contact.law": "rigid"}, unset=["contact.stiffness"])
    assert rest["displacement_m"][1] == pytest.approx(1e-4, abs=1e-12)
    assert rest["contact_force_N"][1] > 0.0


def test_what_is_free_to_move_stands_where_its_contact_balances_the_load(matrix):
    matrix("k.mtx", (CHAIN_STIFFNESS - np.diag([1e6, 0.0, 0.0])).tolist())
    loads = loaded(terms("harmonic = 0\namplitude = 10.0\ndofs = [1]", VIBRATES))
    rest = rest_of(loads, {"structure.free": True, "structure.contact_dofs": [3], "forcing.frequency": 5.0})
    assert rest["contact_force_N"] == [pytest.approx(10.0, abs=1e-6)]
    assert rest["displacement_m"] == [pytest.approx(1e-4 + 10.0 / 1e7, abs=1e-10)]


def test_nothing_is_said_of_rest_without_static_loads():
    scene = loaded(terms(VIBRATES))
    assert "at_rest" not in solved(scene).summary
    assert "at rest" not in wb.check(scene)


TERM = "forcing.terms[1]."


@pytest.mark.parametrize("lines, key, part", [
    ("weight = [0, 0]", "forcing.weight", "expected a list of 3 numbers"),
    ("weight = [0, 1.0, 0]", "forcing.weight", "moves along y"),
    (terms(BASE + 'direction = "y"'), TERM + "direction", "moves along y"),
    (terms(BASE + 'direction = "up"'), TERM + "direction", '"-z"'),
    (terms(BASE + 'direction = "z"\ndofs = [1]'), TERM + "direction", "one or the other"),
    (terms('amplitude = 1.0\ndirection = "z"'), TERM + "direction", 'only with kind = "base_acceleration"'),
    (terms(BASE + 'load = "g.mtx"'), TERM + "load", 'only with kind = "force"'),
    (terms('amplitude = 1.0\nload = "g.mtx"\ndofs = [1]'), TERM + "load", "one or the other"),
    (terms('amplitude = 1.0\nload = "short.mtx"'), TERM + "load", "has 2 entries"),
    (terms('amplitude = 1.0\nload = "none.mtx"'), TERM + "load", "none.mtx"),
])
def test_a_wrong_direction_or_load_is_refused(lines, key, part):
    refused(loaded(lines), key, part)


@pytest.mark.parametrize("lines, key", [
    ("weight = [0, 0, 1.0]", "forcing.weight"), (terms(BASE + 'direction = "z"'), TERM + "direction")])
def test_directions_need_a_map(lines, key):
    refused(changed(loaded(lines), ('dof_map = "chain.dof"', "")), key, "structure.dof_map")


def test_directions_and_loads_are_written_and_described_and_read_back(mapped_chain):
    written = wb.complete(loaded("weight = [0, 0, -9.81]\n" + terms(
        'amplitude = 4.0\nload = "g.mtx"', 'kind = "base_acceleration"\namplitude = 30.0\ndirection = "-z"')))
    assert wb.complete(written) == written
    forcing = tomllib.loads(written)["forcing"]
    assert forcing["weight"] == [0.0, 0.0, -9.81]
    assert forcing["terms"][0]["load"] == f"{mapped_chain}/g.mtx" and forcing["terms"][0]["amplitude"] == 4.0
    base = forcing["terms"][1]
    assert (base["kind"], base["amplitude"], base["direction"]) == ("base_acceleration", 30.0, "-z")
    said = wb.check(written)
    assert "weight: static, [0.0, 0.0, -9.81] m/s^2, 39.24 N in all" in said
    assert "30 m/s^2 along -z" in said
