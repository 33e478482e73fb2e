"""Exact motions of friction with other laws, and their records."""

import math

import pytest

PHASES = '[time]\nmethod = "exact"\n[analysis]\ntype = "forced_response"\n'


def scene(structure, contacts, load, frequency):
    return (f'[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\n{structure}\n{contacts}\n'
            f"[forcing]\nfrequency = {frequency!r}\n{load}\n{PHASES}")


def slider(row, values):
    return f'[[contact.pairs]]\ndofs = [{row}]\nlaw = "coulomb"\n{values}\n'


@pytest.fixture
def two_masses(matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.7]])
    matrix("k.mtx", [[2.0, -1.0], [-1.0, 2.0]])
    return "stiffness_damping = 0.02"


@pytest.mark.parametrize("stop, dissipated", [
    # By integrations of 260 000 steps a period with a separate return mapping: 2.391808 J by friction near the first.
    ('law = "hunt_crossley"\nhertz_stiffness = 10.0\npower = 1.5\ndissipation = 0.5\ngap = 0.5', 0.260145),
    ('law = "kelvin_voigt"\nstiffness = 10.0\ndamping = 0.5\ngap = 5.0', 0.0),  # never touched
])
def test_friction_is_no_part_of_what_damped_contacts_take(run, two_masses, stop, dissipated):
    contacts = slider(1, "friction = 0.4\ntangential_stiffness = 3.0\nnormal_load = 1.0") + f"[[contact.pairs]]\ndofs = [2]\n{stop}\n"
    summary = run(scene(two_masses, contacts, "load_dofs = [2]\namplitude = 1.2", 0.21)).summary
    assert summary["status"] == "converged"
    assert summary["contact_dissipation_J"] == pytest.approx(dissipated, abs=1e-4)
    if dissipated:
        assert summary["friction_work_J"] == pytest.approx(2.391808, abs=2e-5)


def test_an_exact_motion_is_not_held_against_samples(run, matrix):
    """Massless rigid friction and a stop: the forces jump between samples."""
    matrix("m.mtx", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    matrix("k.mtx", [[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])
    contacts = slider(1, "friction = 0.4\nnormal_load = 1.0") + '[[contact.pairs]]\ndofs = [3]\nlaw = "linear"\nstiffness = 8.0\ngap = 0.5\n'
    record = run(scene("stiffness_damping = 0.05", contacts, "load_dofs = [3]\namplitude = 0.8", 0.06))
    assert record.summary["status"] == "converged", record.errors
    assert record.summary["friction_energy_error"] is None
    assert not any("differ" in warning for warning in record.summary["warnings"])


RIGID_BESIDE_DASHPOT = (slider(1, "friction = 0.4\nnormal_load = 1.0") + '[[contact.pairs]]\ndofs = [2]\nlaw = "kelvin_voigt"\n'
                        "stiffness = 5.0\ndamping = 0.3\ngap = 0.3\n")


def test_rigid_friction_beside_a_law_of_the_velocity_is_refused_by_name_where_bases_are_named(command, two_masses, tmp_path):
    bases = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 31\n'
    text = scene(two_masses, RIGID_BESIDE_DASHPOT, "load_dofs = [2]\namplitude = 1.0", 0.1)
    (tmp_path / "scene.toml").write_text(text.replace('[time]\nmethod = "exact"\n', bases))
    checked = command("check", "scene.toml")
    assert checked.code == 2
    assert "tangential_stiffness" in checked.errors and "scene.toml" in checked.errors


def test_rigid_friction_keeps_its_mass_where_no_bases_are_named(run, two_masses):
    text = scene(two_masses, RIGID_BESIDE_DASHPOT, "load_dofs = [2]\namplitude = 1.0", 0.1)
    named, kept = (run(text, "--no-report", set=chosen).summary for chosen in ((), ('contact.mass="keep"',)))
    assert named["status"] == kept["status"] == "converged"
    assert named["max_displacement_m"] == kept["max_displacement_m"]
    assert "contact_mass_frequency_change" not in named


def test_the_former_word_of_the_exact_method_is_refused_and_names_the_new_one(command, two_masses, tmp_path):
    text = scene(two_masses, RIGID_BESIDE_DASHPOT, "load_dofs = [2]\namplitude = 1.0", 0.1)
    (tmp_path / "scene.toml").write_text(text.replace('"exact"', '"phases"'))
    checked = command("check", "scene.toml")
    assert checked.code == 2
    assert 'time.method = "phases": expected "balance" or "exact"; did you mean "exact"?' in checked.errors


def test_an_undamped_structure_at_its_frequency_is_told_as_singular(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    contact = slider(1, "friction = 1.0\ntangential_stiffness = 3.0\nnormal_load = 0.9")
    record = run(scene("", contact, "load_dofs = [1]\namplitude = 1.0", 0.5 / math.pi))
    assert record.code == 3, record.errors
    assert "singular" in record.summary["status"]


def test_a_contact_that_slips_by_little_does_not_depend_on_history(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    matrix("c.mtx", [[0.05]])
    omega = 0.2 * math.pi
    limit = 3.0 / abs(4.0 - omega**2 + 0.05j * omega) * (1.0 - 1e-9)
    contact = slider(1, f"friction = 1.0\ntangential_stiffness = 3.0\nnormal_load = {limit!r}")
    summary = run(scene('damping = "c.mtx"', contact, "load_dofs = [1]\namplitude = 1.0", 0.1)).summary
    (row,) = summary["friction"]
    assert row["slip_fraction"] > 0.0 and not row["history_dependent"]
    assert not any("neither" in warning for warning in summary["warnings"])
