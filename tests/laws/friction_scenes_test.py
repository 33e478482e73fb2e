"""Scenes with friction: read, written, refused with the key, and solved against event-driven exact motions."""

import math

import numpy as np
import pytest
import scipy.io

import wavebalance as wb

OMEGA = 1.225867690198  # of the exact free motion of m = k = k_t = limit = 1 that turns back at 2
BASES = ("time.trial", "time.weight", "time.functions", "time.quadrature_points")
SWEEPING = ("analysis.frequency_from", "analysis.frequency_to", "analysis.first_step", "analysis.largest_step")
MODE = ["analysis.type=nonlinear_mode"]


@pytest.fixture(scope="module")
def folder(scenes_folder):
    return scenes_folder / "friction"


@pytest.fixture(scope="module")
def lift_off(solve):
    return solve("lift_off.toml")


def tangent_of(record):
    """The displacement of the contact along its tangent."""
    along = np.array(record.contacts["direction"]) == "tangent"
    return record.contacts["displacement_m"][along]


def test_a_slider_has_the_work_and_the_shares_of_the_exact_motion(solve):
    record = solve("slider.toml")
    assert record.summary["friction_work_J"] == pytest.approx(16.12103657, abs=1e-4 * 16.12)
    (slip,), (opened,) = (record.summary["friction"][f"{name}_fraction"] for name in ("slip", "open"))
    assert slip == pytest.approx(0.711779414, abs=3e-3) and opened == 0.0
    assert record.summary["stability"] == "stable" and record.summary["unstable_multipliers"] == 0
    # All of the structure is the mass of 1 kg at the contact.
    energy = 0.5 * np.max(record.response["velocity_m_per_s"] ** 2)
    damping = record.summary["equivalent_damping_ratio"]
    assert damping == pytest.approx(16.12103657 / (4.0 * math.pi * energy), abs=1e-4)


def test_a_response_has_the_damping_ratio_that_its_mode_has_nearby(solve):
    # As published for the damped mode of one mass, k = kt = limit = 1: the damping ratio 0.0464 at a turning point of
    # 1.2. Friction dissipates 4 (1.2 - 1) in a cycle.
    record = solve("slider.toml", "structure.stiffness_damping=1e-9", "forcing.frequency=0.2188006",
                   "forcing.amplitude=0.2122", "analysis.output_points=4096")
    assert record.summary["max_displacement_m"] == pytest.approx(1.2, abs=0.05)
    assert record.summary["equivalent_damping_ratio"] == pytest.approx(0.0464, abs=0.003)


@pytest.mark.parametrize("node", [7, 8])
def test_directions_are_taken_by_the_names_of_nodes(folder, changed, tmp_path, monkeypatch, node):
    monkeypatch.chdir(folder)
    (tmp_path / "two.dof").write_text("7.1\n7.2\n")
    mapped = f'damping = "two_dampers.mtx"\ndof_map = "{tmp_path}/two.dof"'
    text = changed((folder / "lift_off.toml").read_text(), ('damping = "two_dampers.mtx"', mapped),
                   ("dofs = [2]                          #", 'dofs = ["node 7 y"] #'),
                   ("tangent = [1]", f'tangent = ["node {node} x"]'))
    if node == 7:
        named, numbered = wb.complete(text), wb.complete(folder / "lift_off.toml")
        pairs = [one[one.index("[[contact.pairs]]"):one.index("[forcing]")] for one in (named, numbered)]
        assert pairs[0] == pairs[1] and "dofs = [2]\n" in pairs[0] and "\ntangent = [1]\n" in pairs[0]
        return
    with pytest.raises(wb.SceneError) as raised:
        wb.complete(text)
    assert "tangent" in raised.value.key and "node 8 is not in" in raised.value.allowed


def test_a_contact_that_lifts_off_has_the_motion_of_the_exact_one(lift_off):
    summary = lift_off.summary
    assert summary["friction_work_J"] == pytest.approx(0.08956782539, abs=1e-4 * 0.0896)
    assert summary["friction"]["open_fraction"][0] == pytest.approx(0.651719143, abs=3e-3)
    assert summary["friction"]["stick_fraction"][0] == pytest.approx(0.3296863, abs=3e-3)
    x = tangent_of(lift_off)
    assert x.max() == pytest.approx(0.7786937648, abs=1e-5) and x.min() == pytest.approx(-0.907916742, abs=1e-5)
    assert summary["stability"] == "stable"
    # The two largest are conjugate.
    multiplier = abs(complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"]))
    assert multiplier == pytest.approx(0.63913085, abs=1e-4)


def test_a_response_says_how_far_it_is_from_the_motion_of_the_structure_and_its_exact_solutions(lift_off):
    # Against event-driven exact motions.
    summary, phases = lift_off.summary, lift_off.summary["phases"]
    assert summary["phases_status"] == "converged" and summary["stability_by"] == "phases"
    assert 1e-7 < summary["error_of_displacement"] < 2e-5 and summary["error_of_force"] < 1e-4
    assert summary["leading_multiplier_real"] == pytest.approx(0.46568686, abs=1e-8)
    assert summary["leading_multiplier_imag"] == pytest.approx(0.43774878, abs=1e-8)
    assert len(phases["state"]) == 3 and phases["contact"][phases["state"].index("slip")] == 1.0
    for state, begin in (("slip", 0.280840393), ("open", 0.299434949), ("stick", 0.951154093)):
        assert phases["begin"][phases["state"].index(state)] == pytest.approx(begin, abs=1e-9)


@pytest.mark.parametrize("how", ["time.method=exact", "time.tolerance=1e-9"])
def test_by_exact_solutions_a_contact_has_the_work_and_the_shares_of_the_exact_motion(solve, how):
    summary = solve("lift_off.toml", how, unset=BASES).summary
    assert summary["solved_by"] == "exact" and summary["stability"] == "stable"
    assert summary["friction_work_J"] == pytest.approx(0.08956782539, abs=1e-9 * 0.0896)
    assert summary["friction"]["open_fraction"][0] == pytest.approx(0.651719143, abs=1e-8)
    assert summary["friction"]["stick_fraction"][0] == pytest.approx(0.3296863, abs=1e-8)


def test_by_exact_solutions_other_laws_are_taken_beside(folder, changed, monkeypatch):
    monkeypatch.chdir(folder)
    stop = '[[contact.pairs]]\ndofs = [1]\nlaw = "linear"\nstiffness = 5.0\ngap = 1.0\n[forcing]'
    text = changed((folder / "lift_off.toml").read_text(), ("[forcing]", stop))
    completed = wb.complete(text, ["time.method=exact"], unset=BASES)
    assert 'law = "linear"' in completed and 'method = "exact"' in completed


def test_a_bolted_beam_is_swept_through_its_resonance_in_few_points(solve):
    # Steps measured by the slip at the start of the sweep need a thousand points.
    record = solve("bolted_beam.toml", "analysis.stability=false")
    assert record.status == "reached_end" and record.summary["points"] <= 100


def test_a_slider_that_begins_to_slip_is_swept_to_the_end_by_long_steps(solve):
    # With grazing events to follow, as other laws of few samples have them, the sweep is lost near its beginning.
    solve("slider.toml", "analysis.type=frequency_sweep", "analysis.frequency_from=0.05", "analysis.frequency_to=0.4",
          "forcing.amplitude=1.25", "contact.tangential_stiffness=25.0", "structure.stiffness_damping=0.04",
          "time.quadrature_points=512")


@pytest.mark.parametrize("name", ["slider.toml", "belt.toml", "lift_off.toml", "bolted_beam.toml", "bolted_beam_mode.toml"])
def test_a_scene_with_friction_is_written_and_read_back_equal(folder, written_equal, name):
    written_equal(folder / name)


def test_without_friction_the_motion_is_that_of_the_normal_law(folder, solve):
    rubbing = solve("lift_off.toml", "contact.friction=0")
    mass, damping, stiffness = (scipy.io.mmread(folder / name) for name in
                                ("two_masses.mtx", "two_dampers.mtx", "coupled_springs.mtx"))
    structure = wb.Structure(mass, damping, stiffness, [2.0, 0.0], contacts=[1, 0], static_load=[0.0, 0.6],
                             forces=[([0.0, 2.0], [0.0, np.exp(-1j * math.radians(40.10704565915762))])])
    alone = wb.forced_response(structure, [wb.Penalty(21.0, -0.6 / 21.0), wb.NoContact()], 0.477464829275686,
                               wb.Pair("fourier", 63, 1024), form="displacement")
    assert alone.converged
    assert tangent_of(rubbing).max() == pytest.approx(alone.displacement[1].max(), rel=1e-9)
    assert rubbing.summary["friction_work_J"] == 0.0


def test_a_contact_that_never_slips_says_that_history_decides(solve):
    record = solve("slider.toml", "contact.normal_load=1000")
    assert record.summary["friction_work_J"] == 0.0
    (warning,) = record.warnings
    assert "neither slips nor opens" in warning


def test_a_mode_has_frequency_and_damping_over_amplitude(solve):
    record = solve("slider.toml", *MODE, "analysis.points=40", "structure.stiffness_damping=0")
    assert record.summary["slip_amplitude_m"] == pytest.approx(1.0, abs=1e-8)
    assert record.summary["linear_frequency_Hz"] == pytest.approx(math.sqrt(2.0) / (2.0 * math.pi), abs=1e-9)
    # Between 2 and 3 the exact damping ratio is 0.1103178 at most.
    assert record.summary["largest_damping_ratio"] == pytest.approx(0.1110, abs=2e-3)
    assert len(record.backbone["damping_ratio"]) > 30
    picture = record.svg()  # of two panels
    assert picture.count("Amplitude / amplitude of slip onset") == 2
    assert "Frequency (" in picture and "Damping ratio" in picture


def test_a_motion_of_a_mode_has_frequency_and_damping_of_the_exact_one(solve):
    # xi / (2 omega) of exact motions is 0.105752880426 where the mass turns back at 2.
    motion = solve("slider.toml", *MODE, "analysis.points=40", "structure.stiffness_damping=0",
                   "analysis.amplitude_ratio=2.000767809")
    assert motion.summary["damping_ratio"] == pytest.approx(0.105752880426, abs=1e-5)
    assert motion.summary["frequency_Hz"] == pytest.approx(OMEGA / (2.0 * math.pi), abs=1e-6)
    assert motion.summary["max_displacement_m"] == pytest.approx(2.0, abs=1e-3)
    assert motion.summary["friction_work_J"] == pytest.approx(4.0, abs=1e-3)  # 4 L (X - L / k_t)
    assert len(motion.response["time_fraction"]) > 0


def test_a_mode_with_lift_off_starts_at_its_static_state(solve):
    backbone = solve("lift_off.toml", *MODE, "analysis.points=40").backbone
    assert backbone["open_fraction"][0] == 0.0 and backbone["open_fraction"][-1] > 0.3
    assert backbone["friction_work_J"][0] == 0.0


@pytest.mark.parametrize("name, overrides, key, expected", [
    ("slider.toml", ["contact.friction=-0.1"], "contact.friction", "in 0..1000"),
    ("slider.toml", ["contact.tangential_stiffness=0"], "contact.tangential_stiffness", "> 0"),
    ("slider.toml", ["contact.normal_load=-1"], "contact.normal_load", ">= 0"),
    ("slider.toml", ["contact.normal_load=0"], "contact.normal_load", "> 0"),
    ("slider.toml", ["contact.normal_stiffness=5"], "contact.normal_stiffness", "expected 0"),
    ("lift_off.toml", ["contact.normal_stiffness=0"], "normal_stiffness", "> 0"),
    ("lift_off.toml", ["contact.law=linear"], "contact.friction", ""),
    ("slider.toml", ["contact.tangential_stiffness=inf"], "contact.tangential_stiffness", "> 0"),
    ("slider.toml", [*MODE, "analysis.cosine_only=true"], "analysis.cosine_only", "false"),
    ("slider.toml", [*MODE, "analysis.energy_ratio=2"], "analysis.energy_ratio", "amplitude_ratio"),
    ("slider.toml", [*MODE, "analysis.largest_energy=20"], "analysis.largest_energy", "largest_amplitude"),
    ("slider.toml", [*MODE, "analysis.largest_amplitude=0.9"], "analysis.largest_amplitude", "> 1"),
    ("slider.toml", [*MODE, "analysis.amplitude_ratio=-1"], "analysis.amplitude_ratio", ">= 0"),
    ("slider.toml", [*MODE, "analysis.mode=2"], "analysis.mode", "at most 1"),
])
def test_a_wrong_key_is_named_with_what_is_allowed(folder, name, overrides, key, expected):
    with pytest.raises(wb.SceneError) as raised:
        wb.complete(folder / name, overrides)
    assert key in raised.value.key and expected in f"{raised.value.key} {raised.value.allowed}"


def test_a_load_is_needed_where_no_normal_direction_gives_the_limit(folder):
    with pytest.raises(wb.SceneError) as raised:
        wb.complete(folder / "slider.toml", unset=["contact.normal_load"])
    assert raised.value.key == "contact.normal_load"
    assert "normal_load = 0.0" in wb.complete(folder / "lift_off.toml", unset=["contact.normal_load"])


def test_the_mode_of_a_bolted_beam_has_its_damping_from_the_joint(solve):
    # Two beams glued at the joint and two that slide there bound the frequency; both have hardly any damping.
    record = solve("bolted_beam_mode.toml", "analysis.points=20", "analysis.largest_amplitude=4")
    assert record.backbone["damping_ratio"][0] == pytest.approx(record.summary["linear_damping_ratio"], abs=1e-6)
    assert record.summary["largest_damping_ratio"] > 0.05 and record.summary["least_frequency_ratio"] < 0.95


def test_without_tangential_stiffness_friction_is_rigid_and_moves_the_mass_of_its_contacts(solve):
    # The beams of ten contacts whose springs of 2e7 N/m are left out: the mass of the contacts goes to the beams, which
    # deflect there by additional springs.
    settings = ("analysis.type=forced_response", "forcing.frequency=145", "structure.kept_modes=30",
                "analysis.stability=false", "analysis.phases=false")
    rigid = solve("bolted_beam.toml", *settings, unset=(*SWEEPING, "contact.tangential_stiffness")).summary
    assert rigid["form"] == "force" and rigid["friction_work_J"] > 0.0
    assert rigid["contact_mass_frequency_change"] < 0.05
    elastic = solve("bolted_beam.toml", *settings, unset=SWEEPING).summary
    assert elastic["form"] == "displacement" and elastic["friction_energy_error"] < 0.05


def test_a_sweep_has_work_and_shares_at_each_point_and_its_first_slip(solve):
    omega = 1.2
    exact = math.hypot(2.0 - omega**2, 0.05 * omega)
    record = solve("slider.toml", "analysis.type=amplitude_sweep", "analysis.amplitude_from=0.2",
                   "analysis.amplitude_to=2", "time.functions=31", "time.quadrature_points=256",
                   "analysis.largest_step=0.1")
    work, slip = record.sweep["friction_work_J"], record.sweep["slip_fraction"]
    assert work[0] == 0.0 and work[-1] == pytest.approx(16.12103657, abs=1e-2)
    assert slip[-1] == pytest.approx(0.711779414, abs=1e-2)
    points = record.summary["special_points"]
    assert points["type"].count("slip") == 1
    assert points["amplitude_N"][points["type"].index("slip")] == pytest.approx(exact, rel=1e-7)
