"""What may help, as a run that was not solved prints it, is accepted by the scene that it is said of."""

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


@pytest.fixture
def advice(run, matrix):
    """The steps that a run which is not solved names."""
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.5]])
    matrix("k.mtx", [[2e3, -1e3], [-1e3, 1e3]])

    def ask(law, analysis=SWEEP, forcing="", *words, **more):
        time = "" if law == "restitution" or "time_stepping" in analysis else BASES
        record = run(STRUCTURE.format(contact=LAWS[law], time=time, analysis=analysis, forcing=forcing), *words, **more)
        assert record.code == 3, record.errors
        found = re.search("what may help: (.*)", record.errors)
        return found.group(1).split("; ") if found else []

    return ask


def test_no_step_names_what_the_law_refuses(advice):
    assert [step for law in LAWS for step in advice(law)]
    for law in ("coulomb", "restitution", "rigid"):
        assert not any("analysis.exact" in step for step in advice(law)), law
    assert "analysis.exact = true" in advice("linear")
    assert not any("time." in step for step in advice("restitution"))


def test_a_damper_that_sets_in_at_once_is_advised_a_depth_and_no_exact_curve(advice):
    assert "contact.damping_depth = 1e-5" in advice("kelvin_voigt")
    assert not any("analysis.exact" in step for step in advice("kelvin_voigt"))
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
