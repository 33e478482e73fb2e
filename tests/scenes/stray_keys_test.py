"""A key without effect in a scene is refused by its name."""

import pytest

BASES = {"trial": '"fourier"', "weight": '"fourier"', "functions": "31", "quadrature_points": "128",
         "formulation": '"strong"', "inner_products": '"exact"', "nyquist": '"drop"'}
RIGID_FRICTION = 'law = "coulomb"\nfriction = 0.3\nnormal_load = 3.0\n'
FRICTION = RIGID_FRICTION + "tangential_stiffness = 1e4\n"
IN_TIME = 'type = "time_stepping"\n'
LAWS = {"linear": 'law = "linear"\nstiffness = 1e4\ngap = 1e-3\n', "friction": FRICTION,
        "rigid friction": RIGID_FRICTION, "impacts": 'law = "rigid"\nrestitution = 0.7\ngap = 1e-3\n'}


@pytest.fixture
def refused(chain, command, tmp_path):
    """The message of a scene that is refused."""

    def ask(contact, analysis, *arguments, **more):
        (tmp_path / "scene.toml").write_text(chain(contact, analysis, **more))
        checked = command("check", "scene.toml", *arguments)
        return checked.errors if checked.code == 2 else ""

    return ask


@pytest.mark.parametrize("key", BASES)
@pytest.mark.parametrize("law", LAWS)
def test_bases_are_refused_where_motions_are_integrated(refused, law, key):
    message = refused(LAWS[law], IN_TIME, time=f"[time]\n{key} = {BASES[key]}\n")
    assert f"time.{key} = " in message and "does not belong" in message


@pytest.mark.parametrize("analysis", ["motions", "shooting"])
def test_motions_by_exact_solutions_take_a_tolerance_and_no_bases(refused, analysis):
    assert "time.functions" in refused(LAWS["linear"], f'type = "{analysis}"\n', time="[time]\nfunctions = 31\n")
    assert not refused(LAWS["linear"], f'type = "{analysis}"\n', time="[time]\ntolerance = 1e-6\n")


def test_modes_take_bases_where_these_have_an_effect(refused):
    mode, bases = 'type = "nonlinear_mode"\n', '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 31\n'
    bare = {"damped": False, "forcing": ""}
    assert not refused(LAWS["linear"], mode, time=bases, **bare)
    assert "time.functions" in refused(LAWS["linear"], mode, time="[time]\nfunctions = 31\n", **bare)
    rigid = 'law = "rigid"\ngap = 1e-3\n'
    assert "time.trial" in refused(rigid, mode, time=bases, **bare)
    assert not refused(rigid, mode, **bare)
    assert not refused(rigid, 'type = "forced_response"\n', "--analysis", "nonlinear_mode", time=bases, **bare)


def test_another_analysis_leaves_the_bases_out(chain, command, tmp_path):
    bases = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 31\n'
    (tmp_path / "scene.toml").write_text(chain(FRICTION, 'type = "forced_response"\n', time=bases))
    checked = command("check", "scene.toml", "--analysis", "time_stepping")
    assert checked.code == 0, checked.errors
    assert "left out" in checked.errors and "time.functions" in checked.errors


def test_rigid_friction_in_time_has_no_slider(refused):
    slider = "slider = 1e-3\n"
    assert "contact.slider" in refused(RIGID_FRICTION + slider, IN_TIME)
    assert not refused(FRICTION + slider, IN_TIME)


def test_a_gap_of_a_normal_direction_needs_one(refused):
    assert "contact.normal_gap" in refused(FRICTION + "normal_gap = 1e-3\n", IN_TIME)
