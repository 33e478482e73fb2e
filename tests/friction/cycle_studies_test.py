"""Limit cycles along a parameter: each run from the cycle before it, against the closed form of a mass on a belt."""

import concurrent.futures
import json
import os
import subprocess

import numpy as np
import pytest
from limit_cycles_test import SCENES, StickSlip, belt

import wavebalance as wb

DAMPING = 0.1


def text(damping=DAMPING):
    """The scene of the closed form, whose damping is a matrix here."""
    return belt(damping)


def highest_speed():
    """The largest speed of the belt with a cycle: the torn-off mass must reach the belt's speed again."""
    def catches(speed):
        try:
            StickSlip(DAMPING, speed=speed)
        except ValueError:
            return False
        return True
    low, high = 0.1, 3.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if catches(middle) else (low, middle)
    return low


def test_a_cycle_is_followed_over_the_speed_of_the_belt_to_its_end(tmp_path):
    last = highest_speed()
    speeds = [0.1, 0.2, 0.9 * last, 0.99 * last, 1.02 * last, 1.1 * last]
    study = wb.study(text(), {"contact.surface_speed": speeds}, {"analysis.random_starts": 0}, follow=True, output=tmp_path)
    table = study.table
    assert list(table["status"]) == ["converged"] * 4 + ["at_rest"] * 2
    expected = [1.0 / StickSlip(DAMPING, speed=speed).period for speed in speeds[:4]]
    np.testing.assert_allclose(table["frequency_Hz"][:4], expected, rtol=1e-9)
    assert list(table["start_from"]) == ["", "run 1", "run 2", "run 3", "run 4", "run 4"]
    assert table["starts"][1] == 1  # Newton's method from the cycle before
    np.testing.assert_array_equal(table["unstable_multipliers"][:4], 0)
    changes = json.loads((tmp_path / "summary.json").read_text())["changes"]
    assert len(changes) == 1 and "Between run 4 (" in changes[0] and "is lost (status at_rest)" in changes[0]


def test_a_cycle_that_appears_on_the_way_is_said(tmp_path):
    last = highest_speed()
    study = wb.study(text(), {"contact.surface_speed": [1.1 * last, 0.2]}, follow=True, output=tmp_path)
    assert list(study.table["converged"]) == [0.0, 1.0]
    changes = json.loads((tmp_path / "summary.json").read_text())["changes"]
    assert len(changes) == 1 and "a limit cycle appears" in changes[0]


def test_runs_that_change_the_structure_follow_too(tmp_path):
    scene = (SCENES / "squeal.toml").read_text().replace("squeal_", f"{SCENES}/squeal_")
    parameters = {"structure.stiffness_damping": [0.01, 0.012, 0.014]}
    followed = wb.study(scene, parameters, follow=True, output=tmp_path / "a").table
    alone = wb.study(scene, parameters, output=tmp_path / "b").table
    assert followed["converged"].all() and list(followed["starts"][1:]) == [1, 1]
    np.testing.assert_allclose(followed["frequency_Hz"], alone["frequency_Hz"], rtol=1e-7)


def test_the_command_starts_from_the_results_of_another_cycle(tmp_path):
    wb.run(text(), output=tmp_path / "first")
    other = StickSlip(DAMPING, speed=0.2)
    command = [os.environ["WAVEBALANCE_COMMAND"], "run", str(tmp_path / "first" / "scene.toml"), "--set", "contact.pairs[1].surface_speed=0.2",
               "--start-from", str(tmp_path / "first"), "--output", str(tmp_path / "second")]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    summary = json.loads((tmp_path / "second" / "summary.json").read_text())
    assert summary["starts"] == 1 and summary["frequency_Hz"] == pytest.approx(1.0 / other.period, rel=1e-9)


@pytest.mark.parametrize("keys, more, part", [
    ({"analysis.type": "time_stepping", "forcing.frequency": 1.0, "forcing.amplitude": 0.0, "forcing.load_dofs": [1]}, {}, "limit_cycle"),
    ({}, {"sampling": "sobol", "samples": 3}, "grid"),
])
def test_other_studies_do_not_follow(keys, more, part):
    with pytest.raises(wb.SceneError) as refusal:
        wb.study(text(), {"contact.surface_speed": {"from": 0.3, "to": 0.5} | ({} if more else {"count": 2})}, keys, follow=True, **more)
    assert "follow" in str(refusal.value) and part in str(refusal.value)


def test_an_executor_does_not_follow():
    with concurrent.futures.ThreadPoolExecutor(1) as executor, pytest.raises(ValueError, match="follow"):
        wb.study((SCENES / "stick_slip.toml"), {"contact.surface_speed": [0.3]}, follow=True, executor=executor)
