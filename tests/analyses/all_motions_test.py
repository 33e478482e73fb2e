"""All motions of an oscillator with a stop at one frequency, analysis.type = "motions"."""

import tomllib

import numpy as np
import pytest
from solved_scenes import (
    FOURIER,
    STOP_MOTIONS,
    folder_of,
    outcome_of,
    refusal,
    rows_of,
    solved,
    table_of,
)

import wavebalance

# Two stable motions and an unstable one between the folds at 0.1699 and 0.1957 Hz.
STIFF = {"contact.stiffness": 4.0, "forcing.amplitude": 0.15}
# At 2.6 rad/s the motion of one period is unstable, and the motion of two is written over both of them.
DOUBLED = {"structure.stiffness_damping": 0.1, "contact.stiffness": 10.0, "contact.gap": 0.1, "forcing.amplitude": 0.8,
           "forcing.frequency": 0.4138028520389279}
BY_BALANCE = {**STOP_MOTIONS, "time": {**FOURIER, "functions": 255, "quadrature_points": 4096},
              "analysis": {"type": "forced_response"}}


def motions_with(overrides=None):
    return solved(STOP_MOTIONS, {**STIFF, **(overrides or {})})


def eight_starts(seed):
    return {"analysis.seed": seed, "analysis.random_starts": 8}


@pytest.mark.parametrize("frequency", [0.1705, 0.18, 0.195])
def test_between_the_folds_are_two_stable_motions_and_an_unstable_one(frequency):
    record = motions_with({"forcing.frequency": frequency})
    assert record.converged and record.warnings == []
    motions = record.summary["motions"]
    assert rows_of(motions) == 3
    stable, share = np.array(motions["stability"]) == "stable", motions["share"]
    assert np.count_nonzero(stable) == 2
    np.testing.assert_array_equal(motions["share_error"], np.sqrt(share * (1.0 - share) / 24.0))
    np.testing.assert_array_equal(share > 0.0, stable)
    np.testing.assert_array_equal(motions["unstable_multipliers"], np.where(stable, 0.0, 1.0))
    assert np.array(motions["found_by"])[~stable] == ["newton"] and set(motions["period"]) == {1.0}
    assert share.sum() == pytest.approx(1.0, abs=1e-15)
    for file, highest in zip(motions["file"], motions["max_displacement_m"]):
        u = table_of(folder_of(record) / file)["displacement_m"]
        assert len(u) == 1024 and u.max() == pytest.approx(highest, abs=1e-12)
    assert record.summary["random_starts"] == 24 and record.summary["starts_without_motion"] == 0
    sentences = outcome_of(record)
    assert len(sentences) == 4
    assert sentences[0] == "From rest and 24 random starts 3 motions were found, and 2 of them are stable."
    assert "not known" not in sentences[1]


@pytest.mark.parametrize("frequency", [0.14, 0.1695, 0.1962, 0.25])
def test_beside_the_folds_there_is_one_motion(frequency):
    motions = motions_with({"forcing.frequency": frequency, "analysis.random_starts": 4}).summary["motions"]
    assert list(motions["share"]) == [1.0] and list(motions["found_by"]) == ["rest"]


def test_motions_of_one_seed_are_the_same_table():
    def table(seed):
        record = wavebalance.run(STOP_MOTIONS, {**STIFF, **eight_starts(seed)})
        return {name: list(values) for name, values in record.summary["motions"].items()}

    first = {name: list(values) for name, values in motions_with(eight_starts(1)).summary["motions"].items()}
    assert table(1) == first
    assert table(4) != first


@pytest.mark.parametrize("number", [0, 1, 2])
def test_motions_are_starts_of_responses_also_the_unstable_one(number):
    record = motions_with(eight_starts(1))
    motions = record.summary["motions"]
    assert rows_of(motions) == 3
    response = solved(BY_BALANCE, STIFF, start_from=folder_of(record) / motions["file"][number])
    assert response.converged, response.status
    assert response.summary["start_distance"] < 1e-4
    assert response.summary["stability"] == motions["stability"][number]


def test_motions_of_two_periods_are_written_with_their_period():
    record = motions_with({**DOUBLED, "analysis.random_starts": 2})
    motions = record.summary["motions"]
    assert list(motions["period"]) == [2.0, 1.0]
    assert motions["stability"][0] == "stable" and motions["found_by"][1] == "newton"
    two = {**STIFF, **DOUBLED, "analysis.subharmonic": 2}
    response = solved(BY_BALANCE, two, start_from=folder_of(record) / "motion_1.csv")
    assert response.converged, response.status
    assert response.summary["start_distance"] < 1e-3 and response.summary["period_of_motion"] == 2
    # A motion of two periods is no start for one; a motion of one is.
    with pytest.raises(ValueError, match="motion_1.csv is a motion of 2 periods of the load"):
        wavebalance.run(BY_BALANCE, {**STIFF, **DOUBLED}, start_from=folder_of(record) / "motion_1.csv")
    assert solved(BY_BALANCE, {**STIFF, **DOUBLED}, start_from=folder_of(record) / "motion_2.csv").converged


def test_motions_that_repeat_too_late_are_counted_and_warned_of():
    record = motions_with({**DOUBLED, "analysis.longest_period": 1, "analysis.random_starts": 2})
    assert record.summary["starts_without_motion"] == 2
    (warning,) = record.warnings
    assert "2 of 2 random starts" in warning


@pytest.mark.parametrize("key, overrides", [
    ("analysis.random_starts", {"analysis.random_starts": -1}),
    ("analysis.longest_period", {"analysis.longest_period": 0}),
    ("analysis.seed", {"analysis.seed": -1}),
    ("analysis.subharmonic", {"analysis.subharmonic": 2}),
    ("structure.loss_factor", {"structure.loss_factor": 0.1}),
    ("structure.elements", {"structure.elements": 401}),
    ("analysis.seed", {"analysis.type": "time_stepping", "analysis.seed": 1}),
])
def test_keys_are_refused_by_their_names(key, overrides):
    assert refusal(STOP_MOTIONS, overrides).key == key


def test_a_rigid_contact_with_mass_is_refused():
    rigid = {**STOP_MOTIONS, "contact": {"law": "rigid", "mass": "keep", "gap": 1.0}}
    assert refusal(rigid).key == "contact.mass"


def test_a_written_scene_is_read_again():
    overrides = {**STIFF, "analysis.seed": 7, "analysis.longest_period": 3}
    written = wavebalance.complete(STOP_MOTIONS, overrides)
    assert wavebalance.complete(written) == written
    analysis = tomllib.loads(written)["analysis"]
    assert (analysis["type"], analysis["seed"], analysis["longest_period"]) == ("motions", 7, 3)
    assert "up to 3 forcing periods" in wavebalance.check(STOP_MOTIONS, overrides)
