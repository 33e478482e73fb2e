"""Scenes with impacts: read, written, refused with the key, and solved against published motions."""

import csv
import math

import numpy as np
import pytest

import wavebalance as wb

BASES = ["time.trial", "time.weight", "time.functions", "time.formulation", "time.quadrature_points",
         "time.inner_products"]
MODE = ["analysis.type=nonlinear_mode", "structure.stiffness_damping=0"]


@pytest.fixture(scope="module")
def folder(scenes_folder):
    return scenes_folder / "impacts"


@pytest.fixture(scope="module")
def oscillator(solve):
    return solve("oscillator.toml")


def columns(record, folder, name):
    """The numbers of a file of a record, by columns."""
    record.write(folder)
    with open(folder / name, newline="") as file:
        head, *rows = csv.reader(file)
    return {key: np.array([float(row[i]) for row in rows]) for i, key in enumerate(head)}


def test_the_oscillator_of_coco_has_its_motion(oscillator, tmp_path):
    # Recipes for Continuation, example 15.2.
    summary = oscillator.summary
    assert summary["solved_by"] == "impacts" and summary["impacts"] == 1.0 and summary["stability"] == "stable"
    assert summary["max_impact_velocity_m_per_s"] == pytest.approx(1.69573294, abs=1e-8)
    assert summary["max_impulse_Ns"] == pytest.approx(3.05231929, abs=1e-8)
    assert summary["leading_multiplier_real"] == pytest.approx(-0.58429531, abs=1e-7)
    impacts = columns(oscillator, tmp_path, "impacts.csv")
    assert impacts["time_fraction"] == pytest.approx([0.0120881625], abs=1e-9)
    assert impacts["velocity_after_m_per_s"] == pytest.approx([-1.35658635], abs=1e-8)


@pytest.mark.parametrize("name, frequency", [("oscillator.toml", 0.15915494309189535),
                                             ("bar_with_end_mass.toml", 0.1432394487827058)])
def test_impacts_lose_as_much_energy_as_the_load_brings_beside_the_damping(solve, tmp_path, name, frequency):
    record = solve(name, "structure.stiffness_damping=1e-9", "analysis.output_points=2048")
    # Work of the load of 1 N at its degree of freedom, the contact, over the period by its velocity, which jumps.
    impacts = columns(record, tmp_path, "impacts.csv")
    at, after = impacts["time_fraction"], impacts["velocity_after_m_per_s"]
    time = np.concatenate([record.response["time_fraction"], at, at, [1.0]])
    velocity = record.response["velocity_m_per_s"]
    velocity = np.concatenate([velocity, impacts["velocity_before_m_per_s"], after, velocity[:1]])
    order = np.argsort(time, kind="stable")
    power = np.cos(2.0 * np.pi * time) * velocity
    lost = record.summary["impact_energy_J"]
    assert np.trapz(power[order], time[order]) / frequency == pytest.approx(lost, rel=1e-3)


def test_a_bar_has_impacts_and_a_motion_of_all_its_nodes(solve, tmp_path):
    record = solve("bar_with_end_mass.toml")
    assert record.summary["impacts"] == 2.0
    assert record.summary["max_displacement_m"] == pytest.approx(0.8, abs=1e-13)
    assert record.summary["max_impact_velocity_m_per_s"] == pytest.approx(1.8136127872, abs=1e-9)
    assert record.summary["structure_left_out"] <= 1e-4
    record.write(tmp_path)
    assert (tmp_path / "motion.mtx").exists()


def test_a_bar_whose_end_has_the_mass_of_an_element_comes_to_rest_after_many_impacts(solve):
    record = solve("../jones_legrand_2014/case2_rigid.toml", "contact.restitution=0.8",
                   unset=[*BASES, "structure.massless_tip"])
    assert record.status == "converged" and record.summary["impacts"] > 20.0
    assert len(record.summary["lasting_contacts"]["begin"]) > 0


def test_a_bar_without_rebound_has_contact_that_lasts(solve):
    record = solve("bar_without_rebound.toml")
    (begin,), (end,) = (record.summary["lasting_contacts"][one] for one in ("begin", "end"))
    assert end > begin + 0.05
    assert record.summary["max_contact_force_N"] > 0.0 and record.summary["stability"] == "stable"
    assert record.summary["max_displacement_m"] == pytest.approx(14.5e-3, abs=1e-12)
    assert record.response["contact_force_N"].min() >= 0.0


def test_a_sweep_passes_grazing_with_stops_of_different_restitution(solve):
    record = solve("between_stops.toml")
    assert record.sweep["frequency_Hz"][0] == 0.02 and record.sweep["impacts"][0] == 0.0
    special = record.summary["special_points"]
    grazing = special["frequency_Hz"][special["type"].index("grazing")]
    assert grazing > 0.02
    # 1 / |1 - w^2 + 0.1 w i| is the motion without contact, which reaches the gap of 1.2 there.
    w = 2.0 * math.pi * grazing
    assert 1.0 / math.hypot(1.0 - w * w, 0.1 * w) == pytest.approx(1.2, abs=1e-9)


def test_all_motions_of_one_frequency_are_found_with_the_shares_of_the_starts(solve, tmp_path):
    record = solve("oscillator.toml", "contact.gap=0", "structure.stiffness_damping=0.05",
                   "forcing.frequency=0.5888732894", "analysis.type=motions", "analysis.random_starts=12")
    shares = record.summary["motions"]["share"]
    assert len(shares) >= 1
    assert sum(shares) + record.summary["starts_without_motion"] / 12.0 == pytest.approx(1.0, abs=1e-12)
    assert len(columns(record, tmp_path, "motion_1_impacts.csv")["time_fraction"]) >= 1


def test_time_stepping_has_the_motion_of_newtons_method(solve, oscillator):
    stepped = solve("oscillator.toml", "analysis.type=time_stepping", "analysis.tolerance=1e-9")
    assert stepped.summary["max_impulse_Ns"] == pytest.approx(oscillator.summary["max_impulse_Ns"], abs=1e-7)
    assert stepped.summary["iterations"] > 10


@pytest.mark.parametrize(
    "name", ["oscillator.toml", "bar_with_end_mass.toml", "bar_without_rebound.toml", "between_stops.toml"])
def test_a_scene_with_impacts_is_written_and_read_back_equal(folder, written_equal, name):
    written_equal(folder / name)


@pytest.mark.parametrize("name, overrides, unset, key, parts", [
    ("oscillator.toml", ["contact.restitution=1.5"], (), "contact.restitution", ["0..1"]),
    ("oscillator.toml", ["contact.restitution=-0.1"], (), "contact.restitution", ["0..1"]),
    ("oscillator.toml", ["contact.law=linear"], (), "contact.restitution", ["rigid"]),
    ("oscillator.toml", ["contact.mass=redistribute"], (), "contact.mass", ["one or the other"]),
    ("oscillator.toml", ["time.functions=63"], (), "time.functions", ["restitution"]),
    ("oscillator.toml", ["time.method=exact"], (), "time.method", ["restitution"]),
    ("oscillator.toml", ["analysis.phases=true"], (), "analysis.phases", ["restitution"]),
    ("between_stops.toml", ["analysis.exact=true"], (), "analysis.exact", ["false"]),
    ("between_stops.toml", ["analysis.motion_at=peak"], (), "analysis.motion_at", ["none"]),
    ("oscillator.toml", ["structure.loss_factor=0.1"], (), "structure.loss_factor", ["0"]),
    ("oscillator.toml", MODE, (), "analysis.type", ["free motion"]),
    ("oscillator.toml", ["contact.mass=keep", "time.trial=fourier", "time.weight=fourier", "time.functions=15"],
     ["contact.restitution"], "", ["restitution", "redistribute"]),
])
def test_a_wrong_key_is_named_with_what_is_allowed(folder, name, overrides, unset, key, parts):
    with pytest.raises(wb.SceneError) as raised:
        wb.complete(folder / name, overrides, unset=unset)
    assert key in raised.value.key
    assert all(part in f"{raised.value.key} {raised.value.allowed}" for part in parts), raised.value.allowed


def test_motions_with_impacts_have_no_functions_to_compare(folder):
    with pytest.raises(ValueError, match="contact.restitution"):
        wb.compare(folder / "oscillator.toml")
