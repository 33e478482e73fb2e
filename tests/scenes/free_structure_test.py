"""Bodies that only contact holds."""

import math

import pytest

GEAR = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
free = true
contact_dofs = [1]
[contact]
law = "clearance"
stiffness = {stiffness}
gap = 40e-6
[[forcing.terms]]
harmonic = 0
dofs = [1]
amplitude = 400.0
[[forcing.terms]]
kind = "base_displacement"
dofs = [2]
amplitude = 0.8e-6
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "frequency_sweep"
frequency_from = 2000
frequency_to = 7000
"""


@pytest.fixture
def gears(matrix):
    def write(stiffness, mass=0.2, ratio=0.04):
        damping = 2.0 * ratio * math.sqrt(mass * stiffness)
        matrix("m.mtx", [[mass, mass], [mass, 2.0 * mass]])
        matrix("k.mtx", [[0.0, 0.0], [0.0, 1.0]])
        matrix("c.mtx", [[damping, 0.0], [0.0, damping]])

    return write


@pytest.mark.parametrize("stiffness", [2e7, 1e8, 2e8, 1e10])
@pytest.mark.parametrize("law", ["clearance", "linear"])
def test_a_free_mass_under_load_rests_where_its_contact_carries_it(run, gears, stiffness, law):
    gears(stiffness)
    record = run(GEAR.format(stiffness=stiffness), "--analysis", "forced_response",
                 set=["forcing.frequency=3000", f"contact.law={law}"])
    assert record.code == 0, record.errors
    assert "rest_status" not in record.summary
    mean = record.summary["rms_displacement_m"]
    assert mean == pytest.approx(40e-6 + 400.0 / stiffness, rel=2e-2)


def test_the_curve_of_a_stiff_free_gear_pair_has_the_folds_of_the_one_on_a_weak_spring(run, gears):
    gears(2e8)
    record = run(GEAR.format(stiffness=2e8))
    assert record.code == 0, record.errors
    folds = [point["frequency_Hz"] for point in record.summary["special_points"] if point["type"] == "fold"]
    assert folds == [pytest.approx(4295.40, rel=5e-4), pytest.approx(3568.06, rel=5e-4)]


def test_a_backlash_far_smaller_than_the_motion_does_not_shorten_the_steps(run, gears):
    gears(2e8)
    record = run(GEAR.format(stiffness=2e8), set=["contact.gap=1e-9", "analysis.stability=false"])
    assert record.code == 0, record.errors
    assert record.summary["points"] < 2000


def test_check_gives_the_rigid_motion_of_a_free_mass_as_a_mode_of_0_hz(command, gears, tmp_path):
    gears(2e8)
    (tmp_path / "gear.toml").write_text(GEAR.format(stiffness=2e8))
    record = command("check", "gear.toml")
    assert "modes      0 Hz (1 rigid motion)\n" in record.text


SOFT = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
[contact]
law = "rigid"
restitution = 0.6
gap = 1.0
[[contact.pairs]]
dofs = [2, 1]
side = "both"
[forcing]
load_dofs = [1]
amplitude = 0.06
[analysis]
type = "frequency_sweep"
frequency_from = 0.1592
frequency_to = 0.17
"""


def test_the_curve_of_a_ball_that_hardly_anything_holds_does_not_depend_on_the_spring(run, matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.05]])
    matrix("c.mtx", [[0.02, 0.0], [0.0, 0.0]])
    largest = []
    for spring in (1e-8, 1e-6, 1e-4):
        matrix("k.mtx", [[1.0, 0.0], [0.0, spring]])
        record = run(SOFT)
        assert record.summary["status"] == "reached_end", spring
        largest.append(record.summary["max_impulse_Ns"])
    assert largest == [pytest.approx(largest[-1], rel=1e-3)] * 3


def test_a_free_ball_between_stiff_dashpots_has_the_exact_motion_of_time_stepping(run, matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.05]])
    matrix("k.mtx", [[1.0, 0.0], [0.0, 0.0]])
    matrix("c.mtx", [[0.02, 0.0], [0.0, 0.0]])
    scene = (SOFT.replace('damping = "c.mtx"', 'damping = "c.mtx"\nfree = true')
             .replace('law = "rigid"\nrestitution = 0.6', 'law = "kelvin_voigt"\nstiffness = 500.0\ndamping = 1.6')
             .replace('amplitude = 0.06', 'amplitude = 0.06\nfrequency = 0.15915494309189535')
             .split("[analysis]")[0])
    exact = run(scene + '[time]\nmethod = "exact"\n[analysis]\ntype = "forced_response"\n')
    assert exact.code == 0, exact.errors
    assert exact.summary["stability"] == "stable"
    stepped = run(scene + '[analysis]\ntype = "time_stepping"\n')
    for name in ("max_displacement_m", "max_contact_force_N"):
        assert exact.summary[name] == pytest.approx(stepped.summary[name], rel=1e-4)
