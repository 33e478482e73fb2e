"""Responses and curves that start from the motion of an earlier run, --start-from."""

import shutil

import pytest
from solved_scenes import STOP, STOP_AMPLITUDE, STOP_MOTIONS, STOP_RESPONSE, folder_of, solved, table_of, warns

import wavebalance

COLUMNS = "time_fraction,displacement_m,velocity_m_per_s,contact_force_N\n"
TWO_INSTANTS = COLUMNS + "0,1,0,0\n0.5,2,0,0\n"


def curve_with(motion_at, scene=STOP):
    """The folder of a curve with motions at places."""
    return folder_of(solved(scene, {"analysis.motion_at": motion_at}))


def top(file):
    return table_of(file)["displacement_m"].max()


def test_a_start_leads_to_the_upper_branch_that_is_not_found_otherwise():
    curve, alone = curve_with([0.18, 0.185]), solved(STOP_RESPONSE)
    near = solved(STOP_RESPONSE, start_from=curve / "motion_0.185Hz_1.csv")
    assert near.converged
    highest = near.summary["max_displacement_m"]
    assert highest == pytest.approx(top(curve / "motion_0.18Hz_1.csv"), abs=1e-9)
    assert highest > 1.1 * alone.summary["max_displacement_m"]
    assert 1e-3 < near.summary["start_distance"] < 0.5


@pytest.mark.parametrize("name", ["motion_0.2N_1.csv", "motion_0.2N_3.csv"])
def test_a_motion_of_an_amplitude_starts_a_response_on_its_branch(name):
    start = curve_with(0.2, STOP_AMPLITUDE) / name
    near = solved(STOP_RESPONSE, start_from=start)
    assert near.converged
    assert near.summary["max_displacement_m"] == pytest.approx(top(start), abs=1e-8)


@pytest.mark.parametrize("other", [
    {"contact.gap": 1.05},
    {"contact.stiffness": 2.2},
    {"time.functions": 101, "time.quadrature_points": 900},
    {"time.trial": "daubechies6", "time.weight": "daubechies6", "time.functions": 128, "time.quadrature_points": 512},
    {"time.sample_offset": 0.5},
    {"contact.form": "force"},
], ids=["gap", "stiffness", "functions", "basis", "points", "form"])
def test_a_start_leads_to_the_same_branch_of_a_neighbouring_scene(other):
    start = curve_with(0.18) / "motion_0.18Hz_1.csv"
    near = solved(STOP_RESPONSE, other, start_from=start)
    assert near.converged, near.status
    assert near.summary["max_displacement_m"] == pytest.approx(top(start), rel=0.06)


def test_a_start_is_the_first_point_of_a_curve():
    start = curve_with(0.185) / "motion_0.185Hz_1.csv"
    upper = solved(STOP, {"analysis.frequency_from": 0.185, "analysis.frequency_to": 0.13}, start_from=start)
    assert upper.converged, upper.status
    assert upper.sweep["max_displacement_m"][0] == pytest.approx(top(start), abs=1e-8)
    assert upper.sweep["unstable"][0] == 0.0


def test_a_response_warns_of_a_motion_far_from_its_start():
    far = solved(STOP_RESPONSE, {"forcing.frequency": 0.24}, start_from=curve_with("peak") / "motion_peak.csv")
    assert far.converged and warns(far, "may be on another branch")


def test_a_start_of_the_motion_itself_is_solved_at_once():
    again = solved(STOP_RESPONSE, start_from=folder_of(solved(STOP_RESPONSE)))
    assert again.summary["start_distance"] < 1e-3
    assert again.summary["iterations"] <= 3 and again.summary["strategy"] == "newton"


def test_a_start_of_one_period_serves_motions_of_two_and_not_the_other_way_round(tmp_path):
    response = folder_of(solved(STOP_RESPONSE)) / "response.csv"
    shutil.copy(response, tmp_path)
    doubled = {"analysis.subharmonic": 2, "time.functions": 125, "time.quadrature_points": 2048}
    twice = wavebalance.run(STOP_RESPONSE, doubled, start_from=tmp_path)
    assert twice.converged and twice.summary["start_distance"] < 1e-3
    (tmp_path / "summary.json").write_text('{"subharmonic": 2}')
    with pytest.raises(ValueError, match="is a motion of 2 periods of the load, and analysis.subharmonic is 1"):
        wavebalance.run(STOP_RESPONSE, start_from=tmp_path)
    assert wavebalance.run(STOP_RESPONSE, doubled, start_from=tmp_path).converged


def test_motions_that_do_not_fit_are_refused(tmp_path):
    instants = [(time / 8.0, contact) for time in range(8) for contact in (1, 2, 3)]
    file = tmp_path / "contacts.csv"
    file.write_text("time_fraction,contact,displacement_m,velocity_m_per_s,contact_force_N\n"
                    + "".join(f"{time},{contact},0,0,0\n" for time, contact in instants))
    with pytest.raises(ValueError) as raised:
        wavebalance.run(STOP_RESPONSE, start_from=file)
    assert str(raised.value) == f"--start-from: {file} has the motion of 3 contacts, but the scene has 1 contact"
    file.write_text(COLUMNS + "".join(f"{time / 8.0},0,0,0\n" for time in range(8)))
    assert wavebalance.run(STOP_RESPONSE, start_from=file).converged
    stepping = {**STOP_MOTIONS, "analysis": {"type": "time_stepping"}}
    with pytest.raises(ValueError, match='analysis.type = "time_stepping" has no start'):
        wavebalance.run(stepping, start_from=file)


@pytest.mark.parametrize("files, start, said", [
    ({}, "nowhere", "does not exist"),
    ({}, "", "holds no motion"),
    ({"motion_peak.csv": TWO_INSTANTS, "motion_fold_1.csv": TWO_INSTANTS}, "", "motion_fold_1.csv, motion_peak.csv"),
    ({"a.csv": "time_fraction,displacement_m\n0,1\n"}, "a.csv", "contact_force_N"),
    ({"b.csv": TWO_INSTANTS.replace("0.5,2", "0.7,2")}, "b.csv", "uniform"),
    ({"c.csv": TWO_INSTANTS.replace("0.5,2", "0.5,nan")}, "c.csv", "finite"),
    ({"motion_peak.csv": TWO_INSTANTS}, "", None),
])
def test_an_error_says_what_a_folder_lacks(tmp_path, files, start, said):
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    if said is None:
        assert wavebalance.run(STOP_RESPONSE, start_from=tmp_path / start).summary["start_distance"] > 0.0
        return
    with pytest.raises(OSError, match=said):
        wavebalance.run(STOP_RESPONSE, start_from=tmp_path / start)
