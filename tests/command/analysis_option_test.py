"""Another analysis of a scene, without the keys that do not belong to it."""

import pytest
import wavebalance as wb
from command_scenes import CHAIN, changed

SWEEP = """type = "frequency_sweep"
frequency_from = 40.0
frequency_to = 60.0
motion_at = "peak"
motion_points = 8
largest_step = 0.5"""


@pytest.fixture
def sweep(masses):
    """The file of a sweep with a static load in addition to the harmonic one."""
    masses.write_text(changed(CHAIN, ('type = "forced_response"', SWEEP),
                              ("[time]", "[[forcing.terms]]\nharmonic = 0\namplitude = 3.0\n[time]")))
    return masses


def test_keys_of_a_sweep_are_left_out_for_a_response(command, sweep):
    record = command("run", sweep, "--output", "out", "--analysis", "forced_response", "--no-report")
    assert record.code == 0, record.errors
    assert record.errors == ('wavebalance: left out for analysis.type = "forced_response": analysis.frequency_from, '
                             "analysis.frequency_to, analysis.motion_at, analysis.largest_step\n")
    assert 'type = "forced_response"' in wb.complete(record.folder / "scene.toml")


def test_damping_and_loads_are_left_out_for_a_nonlinear_mode(command, sweep):
    checked = command("check", sweep, "--analysis", "nonlinear_mode")
    assert checked.code == 0, checked.errors
    for name in ("structure.modal_damping", "forcing.terms", "analysis.motion_at"):
        assert name in checked.errors


def test_what_is_set_beside_the_analysis_is_kept(command, masses):
    checked = command("check", masses, "--analysis", "frequency_sweep", "--set", "analysis.frequency_from=40", "--set",
                      "analysis.frequency_to=60")
    assert checked.code == 0, checked.errors
    assert "40 to 60 Hz" in checked.text


def test_another_name_is_answered_with_the_analyses_that_there_are(command, masses):
    checked = command("check", masses, "--analysis", "response")
    assert checked.code == 2
    assert "--analysis response" in checked.errors and '"forced_response"' in checked.errors


def test_all_terms_are_unset_by_one_name(sweep):
    assert "[[forcing.terms]]" in wb.complete(sweep)
    assert "[[forcing.terms]]" not in wb.complete(sweep, unset=["forcing.terms"])


def test_the_first_step_is_not_longer_than_the_largest_one(sweep):
    assert "\nfirst_step = 0.001 " in wb.complete(sweep, {"analysis.largest_step": 0.001})
