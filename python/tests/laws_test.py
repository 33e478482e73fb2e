"""Contact laws of the catalogue: their values, their classes and their scenes."""

import inspect

import numpy as np
import pytest

import wavebalance as wb

LAWS = [
    wb.NoContact(),
    wb.Penalty(5.0, 0.1),
    wb.Exponential(2.0, 3.0, 0.1),
    wb.Rigid(0.1),
    wb.Bilinear(1.0, 3.0, 0.1),
    wb.Cubic(2.0),
    wb.Polynomial([1.0, 0.0, 2.0]),
    wb.Clearance(5.0, 0.1, gap_below=0.2),
    wb.HuntCrossley(5.0, 0.2, 0.1),
    wb.KelvinVoigt(5.0, 0.2, 0.1),
]
WITH_A_FORCE = [
    *(law for law in LAWS if not isinstance(law, (wb.NoContact, wb.Rigid))),
    wb.Table([-1.0, 0.0, 1.0], [-1.0, 0.0, 2.0]),
]


@pytest.mark.parametrize("law", WITH_A_FORCE, ids=lambda law: type(law).__name__)
def test_tangent_and_potential_belong_to_the_force(law):
    u = np.array([-0.7, -0.05, 0.05, 0.33, 0.8])
    step = 1e-6
    np.testing.assert_allclose((law.force(u + step) - law.force(u - step)) / (2 * step), law.tangent(u), atol=1e-6)
    np.testing.assert_allclose((law.potential(u + step) - law.potential(u - step)) / (2 * step), law.force(u), atol=1e-6)
    assert law.force(0.8) > 0.0 and repr(law).startswith(type(law).__name__)


def test_every_law_of_the_catalogue_has_a_class_that_takes_its_parameters():
    classes = {one._row: one for one in wb.Law.__subclasses__() if one._row}
    rows = {row["name"]: {one["name"] for one in row["parameters"]} for row in wb._core.law_catalogue()}
    assert classes.keys() == rows.keys()
    for law in LAWS:
        keys = law.scene_keys()
        assert set(keys) - {"law"} <= rows[keys["law"]]


def test_a_class_made_from_a_row_is_that_law():
    row = next(one for one in wb._core.law_catalogue() if one["name"] == "kelvin_voigt")
    made, written = wb.laws._class_of(row), wb.KelvinVoigt(5.0, 0.2, 0.1)
    assert made.__name__ == "KelvinVoigt" and "damping`, N s/m: " in made.__doc__
    assert str(inspect.signature(made)) == "(stiffness, damping, damping_depth=0.0, gap=0.0)"
    law = made(5.0, damping=0.2, gap=0.1)
    assert law.force(0.3, 1.0) == written.force(0.3, 1.0)
    assert law.scene_keys() == {"law": "kelvin_voigt", "stiffness": 5.0, "damping": 0.2, "damping_depth": 0.0, "gap": 0.1}
    with pytest.raises(TypeError, match="stiffness"):
        made()


def test_values_that_make_no_law_are_refused_with_parameter_value_and_range():
    with pytest.raises(ValueError, match='the law "linear": stiffness is -1; it must be a number in N/m, finite and above 0'):
        wb.Penalty(-1.0)
    with pytest.raises(ValueError, match="cubic_stiffness is 0; it must be a number in N/m\\^3, finite and not zero"):
        wb.Cubic(0.0)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_a_response_has_the_digits_of_the_scene_of_the_same_structure(law):
    matrix = np.array([[5.0, -2.0], [-2.0, 2.0]])
    contacts = np.array([[0.0, 1.0]]) if law.is_rigid else np.array([[1.0, -1.0], [0.0, 1.0]])
    mass = "redistribute" if law.is_rigid else "keep"
    structure = wb.Structure(np.diag([1.0, 0.5]), 1e-2 * matrix, matrix, [0.0, 1.0], contacts, contact_mass=mass)
    record = wb.run(structure.scene(law, frequency=0.1))
    motion = wb.forced_response(structure, law, 0.1).motion(1024)
    assert record.converged
    assert record.summary["max_displacement_m"] == motion.displacement.max()


def test_a_rigid_law_with_restitution_is_a_scene_with_impacts():
    one = np.eye(1)
    structure = wb.Structure(one, 0.1 * one, one, [1.0], contacts=[0])
    scene = structure.scene(wb.Rigid(1.0, restitution=0.8), frequency=0.5 / np.pi)
    assert "time" not in scene and scene["contact"]["restitution"] == 0.8
    record = wb.run(scene)
    assert record.converged and record.summary["solved_by"] == "impacts"
    assert abs(record.summary["max_impact_velocity_m_per_s"] - 1.69573294) < 1e-8
    with pytest.raises(ValueError, match="restitution"):
        wb.forced_response(structure, wb.Rigid(1.0, restitution=0.8), 0.5 / np.pi)
    with pytest.raises(ValueError, match="in 0..1"):
        wb.Rigid(1.0, restitution=1.5)
    with pytest.raises(ValueError, match="no pair"):
        structure.scene(wb.Rigid(1.0, restitution=0.8), frequency=1.0, pair=wb.Pair())


@pytest.mark.parametrize("law", [
    wb.Coulomb(0.3, None, 2.0), wb.Coulomb(0.3, 40.0, 2.0, surface_speed=0.1), wb.Coulomb(0.3, 40.0, 2.0, tangential_damping=0.2)])
def test_friction_without_a_balance_is_a_scene_from_event_to_event(law):
    structure = wb.Structure(np.eye(1), 0.1 * np.eye(1), np.eye(1), [1.0], contacts=[0])
    with pytest.raises(ValueError, match=r"friction have no functions; expected wavebalance.run\(structure.scene"):
        wb.forced_response(structure, law, 0.2)
    with pytest.raises(ValueError, match="no pair"):
        structure.scene(law, frequency=0.2, pair=wb.Pair())
    record = wb.run(structure.scene(law, frequency=0.2))
    assert record.converged and record.summary["solved_by"] == "exact"
    assert record.summary["friction"]["slip_m"][0] > 0.1


def jeffcott():
    """A rotor of 1 kg on springs of 1 N/m, under a load of 0.363 N that turns."""
    turning = [([0.0, 0.363], [0.0, -1j])]
    return wb.Structure(np.eye(2), 0.1 * np.eye(2), np.eye(2), [0.363, 0.0], [0, 1], forces=turning)


def test_a_ring_takes_two_directions_in_functions_and_in_scenes():
    ring, frequency = wb.Ring(5.0, 1.0), 1.1 / (2.0 * np.pi)
    assert ring.rows == 2
    with pytest.raises(TypeError, match="gap"):
        wb.Ring(5.0)
    response = wb.forced_response(jeffcott(), ring, frequency, wb.Pair("fourier", 31))
    assert np.hypot(*response.displacement) == pytest.approx(1.1151660291831718, abs=1e-9)
    scene = jeffcott().scene(ring, frequency=frequency, pair=wb.Pair("fourier", 31))
    assert wb.run(scene).summary["max_displacement_m"] == pytest.approx(1.115166, abs=1e-5)
    with pytest.raises(ValueError, match="several rows"):
        jeffcott().scene([ring, wb.Penalty(5.0)], frequency=frequency)


def test_friction_with_a_normal_direction_is_a_scene():
    law = wb.Coulomb(0.3, 10.0, normal_load=1.0, normal_stiffness=5.0)
    record = wb.run(jeffcott().scene(law, frequency=0.1, pair=wb.Pair("fourier", 31)))
    assert record.summary["contacts"] == 1
    assert record.summary["contact_directions"] == 2
