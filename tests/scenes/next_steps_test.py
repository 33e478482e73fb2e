"""Remedies that an unsolved run prints are accepted by its scene."""

import re

import pytest

STRUCTURE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
modal_damping = 0.02
contact_dofs = [2]
[contact]
{contact}
[forcing]
load_dofs = [1]
amplitude = 5.0
{forcing}
{time}
[analysis]
{analysis}
"""
BASES = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 32\n'
SWEEP = 'type = "frequency_sweep"\nfrequency_from = 3.0\nfrequency_to = 6.0\nmax_points = 3\n'
LAWS = {
    "linear": 'law = "linear"\nstiffness = 1e4\ngap = 1e-3',
    "coulomb": 'law = "coulomb"\nfriction = 0.3\nnormal_load = 3.0\ntangential_stiffness = 1e4',
    "kelvin_voigt": 'law = "kelvin_voigt"\nstiffness = 1e4\ndamping = 1.0\ngap = 1e-3',
    "restitution": 'law = "rigid"\nrestitution = 0.7\ngap = 1e-3',
    "rigid": 'law = "rigid"\ngap = 1e-3',
}


@pytest.fixture(scope="module")
def known():
    """Output of runs of this file, by their scenes and changes: bifurcation points with dampers take seconds."""
    return {}


@pytest.fixture
def advice(run, matrix, known, tmp_path):
    """The steps that a run which is not solved names; its scene is scene.toml."""
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.5]])
    matrix("k.mtx", [[2e3, -1e3], [-1e3, 1e3]])

    def ask(law, analysis=SWEEP, forcing="", *words, **more):
        time = "" if law == "restitution" or "time_stepping" in analysis else BASES
        scene = STRUCTURE.format(contact=LAWS[law], time=time, analysis=analysis, forcing=forcing)
        (tmp_path / "scene.toml").write_text(scene)
        key = (scene, words, str(more))
        if key not in known:
            record = run(scene, *words, **more)
            assert record.code == 3, record.errors
            found = re.search("what may help: (.*)", record.errors)
            known[key] = found.group(1).split("; ") if found else []
        return known[key]

    return ask


def test_no_step_names_what_the_law_refuses(advice):
    assert [step for law in LAWS for step in advice(law)]
    for law in ("restitution", "rigid"):
        assert not any("analysis.exact" in step for step in advice(law)), law
    for law in ("linear", "coulomb"):
        assert "analysis.exact = true" in advice(law), law
    assert not any("time." in step for step in advice("restitution"))


def test_a_damper_that_sets_in_at_once_is_advised_the_exact_curve_and_then_a_depth(advice):
    steps = advice("kelvin_voigt")
    assert steps.index("analysis.exact = true") + 1 == steps.index("contact.damping_depth = 1e-5")
    assert "analysis.exact = true without analysis.motion_at" in advice("kelvin_voigt", set=['analysis.motion_at=["peak"]'])
    assert "contact.damping_depth = 2e-7" in advice("kelvin_voigt", set=["contact.gap=2e-5"])
    deeper = advice("kelvin_voigt", set=["contact.damping_depth=1e-5"])
    assert "analysis.exact = true" in deeper and not any("damping_depth" in step for step in deeper)


def test_steps_with_values_are_accepted_as_they_stand(advice, command):
    tried = 0
    for law in LAWS:
        for step in advice(law):
            if not re.fullmatch(r"[a-z_.\[\]0-9]+ = \S+", step):
                continue
            tried += 1
            checked = command("check", "scene.toml", "--set", step.replace(" = ", "="))
            assert checked.code == 0, (law, step, checked.errors)
    assert tried > 0


def test_time_stepping_is_not_advised_bases_in_time(advice):
    steps = advice("linear", 'type = "time_stepping"\nmax_periods = 3\n', "frequency = 3.0")
    assert any("analysis.max_periods" in step for step in steps)
    assert not any("time." in step for step in steps)


PAIRS = "[[contact.pairs]]\ndofs = [2]\n[[contact.pairs]]\ndofs = [1]\n"
IN_TIME = {
    "friction": LAWS["coulomb"],
    "rigid friction": 'law = "coulomb"\nfriction = 0.3\nnormal_load = 3.0',
    "impacts": LAWS["restitution"],
    "impacts and friction": LAWS["restitution"] + "\n" + PAIRS + LAWS["coulomb"],
    "impacts and springs": LAWS["restitution"] + "\n" + PAIRS + LAWS["linear"],
}


def as_arguments(step):
    """The arguments that make a step of words, or nothing where a value is left to the reader."""
    analysis = re.match(r'analysis.type = "(\w+)"', step)
    if analysis is None:
        return ["--set", step.replace(" = ", "=")] if re.fullmatch(r"[a-z_.\[\]0-9]+ = \S+", step) else None
    words = ["--analysis", analysis.group(1)]
    if "time.trial" in step:
        words += ["--set", 'time.trial="fourier"', "--set", 'time.weight="fourier"', "--set", "time.functions=127"]
    return words + (["--set", "analysis.subharmonic=2"] if "subharmonic" in step else [])


@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("law", IN_TIME)
@pytest.mark.parametrize("periods", [2, 400])
def test_steps_of_motions_in_time_are_accepted(chain, run, command, law, free, periods):
    scene = chain(IN_TIME[law], f'type = "time_stepping"\nmax_periods = {periods}\n')
    if "pairs" in scene:
        scene = scene.replace("contact_dofs = [2]\n", "")
    record = run(scene.replace("[contact]", "free = true\n[contact]" if free else "[contact]"))
    if record.code == 0:
        return
    found = re.search("what may help: (.*)", record.errors)
    steps = found.group(1).split("; ") if found else []
    assert steps or record.summary["status"] == "subharmonic"  # a motion is found, and no analysis may have it
    for step in steps:
        words = as_arguments(step)
        if words is not None:
            checked = command("check", "scene.toml", *words)
            assert checked.code == 0, (step, checked.errors)


def test_impacts_that_do_not_settle_in_time_have_a_step(chain, run):
    record = run(chain(LAWS["restitution"], 'type = "time_stepping"\nmax_periods = 2\n'))
    assert record.summary["status"] == "iteration_limit"
    assert "more analysis.max_periods" in record.errors


def test_no_response_is_advised_where_it_is_refused(chain, command, matrix, tmp_path):
    size = 30
    scene = chain(LAWS["restitution"] + "\n" + PAIRS + LAWS["linear"], 'type = "time_stepping"\n')
    matrix("m.mtx", [[float(i == j) for j in range(size)] for i in range(size)])
    matrix("k.mtx", [[2e3 if i == j else -1e3 * (abs(i - j) == 1) for j in range(size)] for i in range(size)])
    (tmp_path / "scene.toml").write_text(scene.replace("contact_dofs = [2]\n", ""))
    checked = command("check", "scene.toml")
    assert "structure.kept_modes = 8" in checked.text
    assert "forced_response" not in checked.text
