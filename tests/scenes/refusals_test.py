"""Invalid scenes are refused by check as by run, with file, key and allowed values."""

import signal
import subprocess
import os
import time

import pytest

SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
{structure}
{contact}
[forcing]
load_dofs = [1]
amplitude = {amplitude}
{frequency}
{time}
[analysis]
type = "{analysis}"
{more}
"""
BASES = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 31\n'
LAWS = {
    "coulomb": 'law = "coulomb"\nfriction = 0.3\nnormal_load = 3.0\ntangential_stiffness = 1e4',
    "rigid friction": 'law = "coulomb"\nfriction = 0.3\nnormal_load = 3.0',
    "restitution": 'law = "rigid"\nrestitution = 0.7\ngap = 1e-3',
    "linear": 'law = "linear"\nstiffness = 1e4\ngap = 1e-3',
    "kelvin_voigt": 'law = "kelvin_voigt"\nstiffness = 1e4\ndamping = 1.0\ngap = 1e-3',
}
SWEEPS = {
    "forced_response": "",
    "frequency_sweep": "frequency_from = 3.0\nfrequency_to = 3.1\nmax_points = 5",
    "amplitude_sweep": "amplitude_from = 1.0\namplitude_to = 1.1\nmax_points = 5",
    "time_stepping": "max_periods = 5",
    "shooting": "",
    "motions": "random_starts = 1",
}


@pytest.fixture
def matrices(matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.5]])
    matrix("k.mtx", [[2e3, -1e3], [-1e3, 1e3]])
    matrix("free.mtx", [[1e3, -1e3], [-1e3, 1e3]])
    matrix("rotor.mtx", [[2e3, -9e2], [-1e3, 1e3]])


@pytest.fixture
def verdicts(matrices, command, run, tmp_path):
    """Output of check and then run for a scene."""

    def ask(contact, structure="contact_dofs = [2]", analysis="forced_response", *arguments, set=(), solve=True):
        bases = "" if "restitution" in contact or analysis in ("time_stepping", "shooting", "motions") else BASES
        text = SCENE.format(structure=structure, contact=contact, time=bases, analysis=analysis, more=SWEEPS[analysis],
                            amplitude=1.0 if analysis == "amplitude_sweep" else 5.0,
                            frequency="" if analysis == "frequency_sweep" else "frequency = 3.0")
        (tmp_path / "scene.toml").write_text(text)
        sets = [word for pair in set for word in ("--set", pair)]
        checked = command("check", "scene.toml", *sets, *arguments)
        return checked, run(text, *arguments, set=set) if solve else None

    return ask


def refused(record, *parts):
    assert record.code == 2, record.text
    assert "scene.toml" in record.errors or "--set" in record.errors, record.errors
    for part in parts:
        assert part in record.errors, record.errors


@pytest.mark.parametrize("law", LAWS)
def test_a_free_structure_that_is_accepted_by_check_is_solved_by_run(verdicts, law):
    for analysis in SWEEPS:
        checked, ran = verdicts("[contact]\n" + LAWS[law], "contact_dofs = [2]\nfree = true", analysis,
                                set=["structure.stiffness=free.mtx"])
        if checked.code == 2:
            refused(checked)
            refused(ran)
        else:
            assert ran.code in (0, 3), (analysis, ran.errors)


@pytest.mark.parametrize("damping", ["", "loss_factor = 0.02"])
def test_friction_is_solved_to_a_tolerance_whatever_the_damping(verdicts, damping):
    checked, ran = verdicts("[contact]\n" + LAWS["coulomb"], "contact_dofs = [2]\n" + damping, "forced_response",
                            "--unset", "time.functions", set=["time.tolerance=1e-2"])
    assert checked.code == 0, checked.errors
    assert ran.code in (0, 3), ran.errors


def test_pairs_that_all_have_a_law_need_none_of_the_scene(verdicts):
    stops = "".join(f"[[contact.pairs]]\ndofs = [2]\nside = \"{side}\"\n" + LAWS["linear"] + "\n"
                    for side in ("positive", "negative"))
    slider = "[[contact.pairs]]\ndofs = [1]\n" + LAWS["coulomb"] + "\n"
    checked, ran = verdicts(stops + slider, "modal_damping = 0.02")
    assert checked.code == 0, checked.errors
    assert ran.code == 0 and "3 contacts" in checked.text, ran.errors
    checked, _ = verdicts(stops + "[[contact.pairs]]\ndofs = [1]\n", "modal_damping = 0.02", solve=False)
    refused(checked, "contact.pairs[3].law: missing, where other pairs have one")


def test_laws_beside_a_rigid_contact_without_a_law_of_impact_are_refused(verdicts):
    rigid = "[contact]\nlaw = \"rigid\"\ngap = 1e-3\n[[contact.pairs]]\ndofs = [2]\n[[contact.pairs]]\ndofs = [1]\n"
    checked, _ = verdicts(rigid + LAWS["coulomb"], "", solve=False)
    refused(checked, "contact.pairs[2].law", "friction beside a rigid contact needs a law of impact", "contact.restitution")
    checked, _ = verdicts(rigid + LAWS["linear"], "", solve=False)
    refused(checked, "contact.pairs[2].law", "another law beside a rigid contact needs a law of impact")


@pytest.mark.parametrize("tangents, key", [
    ("tangent = [2]", "tangent"),
    ("tangent = [2]\ntangent_coefficients = [-3.0]", "tangent"),
    ("tangent = [1]\nsecond_tangent = [1]", "second_tangent"),
    ("tangent = [1]\nsecond_tangent = [1, 2]\nsecond_tangent_coefficients = [1.0, 2.0]", "second_tangent"),
])
def test_a_tangent_is_another_direction_than_the_normal_and_the_other_tangent(verdicts, tangents, key):
    pair = f"[[contact.pairs]]\ndofs = [2]\n{tangents}\n" + LAWS["coulomb"] + "\nnormal_stiffness = 1e4\n"
    checked, _ = verdicts(pair, "", solve=False)
    refused(checked, f"contact.pairs[1].{key}")


def test_a_coefficient_of_friction_is_at_most_a_thousand(verdicts):
    checked, _ = verdicts("[contact]\n" + LAWS["coulomb"], set=["contact.friction=1e300"], solve=False)
    refused(checked, "contact.friction", "in 0..1000")


@pytest.mark.parametrize("change, meant", [
    ("analysis.frequency_start=3.0", "analysis.frequency_from"),
    ("time.harmonics=5", "time.functions = 2 x harmonics + 1"),
    ("time.points=64", "time.quadrature_points"),
    ("contact.side=both", "contact.pairs, each with a side"),
    ("contact.law=penalty", '"linear"'),
    ("contact.law=unilateral", '"linear"'),
])
def test_names_of_other_programs_are_answered_with_those_of_here(verdicts, change, meant):
    checked, _ = verdicts("[contact]\n" + LAWS["linear"], set=[change], solve=False)
    refused(checked, f"did you mean {meant}?")


def test_another_analysis_of_a_rotor_names_what_it_does_not_take(verdicts):
    rotor = "contact_dofs = [2]\nunsymmetric = true"
    checked, _ = verdicts("[contact]\n" + LAWS["linear"], rotor, "forced_response", "--analysis", "nonlinear_mode",
                          set=["structure.stiffness=rotor.mtx"], solve=False)
    refused(checked, "structure.unsymmetric", 'analysis.type = "nonlinear_mode"')
    assert "left out" not in checked.errors or "structure.unsymmetric" not in checked.errors.splitlines()[0]
    assert "if it is meant" not in checked.errors


def test_check_of_friction_foresees_no_time(verdicts):
    checked, _ = verdicts("[contact]\n" + LAWS["coulomb"], analysis="frequency_sweep", solve=False)
    assert "not predictable with friction" in checked.text
    checked, _ = verdicts("[contact]\n" + LAWS["linear"], analysis="frequency_sweep", solve=False)
    assert "s for the curve" in checked.text


def test_a_search_for_motions_that_is_interrupted_writes_what_it_found(matrices, tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE.format(
        structure="contact_dofs = [2]\nmodal_damping = 0.02", contact="[contact]\n" + LAWS["linear"], amplitude=5.0,
        frequency="frequency = 3.0", time="", analysis="motions", more="random_starts = 1000000"))
    running = subprocess.Popen([os.environ["WAVEBALANCE_COMMAND"], "run", "scene.toml", "--output", "out"], cwd=tmp_path,
                               stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    time.sleep(1.5)
    running.send_signal(signal.SIGINT)
    _, errors = running.communicate(timeout=100)
    assert running.returncode == 130, errors
    summary = (tmp_path / "out" / "summary.json").read_text()
    assert '"status": "interrupted"' in summary and "motion_1.csv" in summary
    assert (tmp_path / "out" / "motion_1.csv").exists()


def test_equal_frequencies_of_modes_are_called_equal(matrix, run):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 1.0]])
    matrix("k.mtx", [[1e3, 0.0], [0.0, 1e3]])
    record = run("""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [2]
[contact]
law = "linear"
stiffness = 1e4
gap = 1e-3
[analysis]
type = "nonlinear_mode"
points = 3
last_frequency_ratio = 1.01
""")
    assert "The linear frequencies of modes 1 and 2 are equal" in record.errors


def test_a_folder_that_may_not_be_written_is_named(verdicts, tmp_path, command):
    verdicts("[contact]\n" + LAWS["linear"], solve=False)
    (tmp_path / "taken").write_text("a file")
    record = command("run", "scene.toml", "--output", "taken/out")
    assert record.code == 2 and "taken/out" in record.errors, record.errors


def test_the_scene_of_a_record_has_its_loads_where_they_are_terms_alone(matrices, run, command):
    record = run(SCENE.format(
        structure="contact_dofs = [2]\nmodal_damping = 0.02", contact="[contact]\n" + LAWS["linear"], amplitude="",
        frequency="", time=BASES, analysis="frequency_sweep", more=SWEEPS["frequency_sweep"]).replace(
            "load_dofs = [1]\namplitude = ", '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 3.0'))
    assert record.code == 3, record.errors  # of five points
    assert "[[forcing.terms]]" in (record.folder / "scene.toml").read_text()
    checked = command("check", record.folder / "scene.toml")
    assert checked.code == 0, checked.errors
