"""Motions at points of a curve, analysis.motion_at."""

import math
import tomllib

import numpy as np
import pytest
import scipy.io
from near_motion import NearMotion
from solved_scenes import (
    CHAIN,
    STOP,
    STOP_AMPLITUDE,
    figure_of,
    folder_of,
    refusal,
    rows_of,
    solved,
    table_of,
    warns,
    where,
)

import wavebalance

NO_STABILITY = {"analysis.stability": False}


def motion(record, name):
    return table_of(folder_of(record) / name)


def highest(record, name):
    return motion(record, name)["displacement_m"].max()


def files_of(record, ending):
    return {file.name for file in folder_of(record).glob(f"motion_*{ending}")}


@pytest.mark.parametrize("given, written", [
    ("peak", "peak"),
    (0.2, 0.2),
    (["peak", "special", 0.2, 0.18, 0.2], ["peak", "special", 0.2, 0.18]),
    ([0.2], 0.2),
    (["special"], "special"),
    ([0.2, "peak", 0.18], ["peak", 0.2, 0.18]),
    (["peak", 2], ["peak", 2.0]),
])
def test_motion_at_is_one_name_one_frequency_or_a_list_and_is_written_as_it_was_read(given, written):
    of_ones = {"analysis.frequency_from": 1, "analysis.frequency_to": 3} if given == ["peak", 2] else {}
    text = wavebalance.complete(STOP, {**of_ones, "analysis.motion_at": given})
    found = tomllib.loads(text)["analysis"]["motion_at"]
    assert (found if isinstance(found, list) else [found]) == (written if isinstance(written, list) else [written])
    assert wavebalance.complete(text) == text
    assert "motion_at" not in wavebalance.complete(STOP)


@pytest.mark.parametrize("value, part, more", [
    ("top", '"peak", "special" or a number in Hz or N, > 0, or a list of these', {}),
    (["peak", "pek"], '"pek" is none of them', {}),
    ([], "or a list of these", {}),
    (True, "or a list of these", {}),
    (-1, "out of range", {}),
    (0.3, "0.3 Hz is outside the sweep; expected a frequency from 0.13 to 0.25 Hz", {}),
    ("special", "analysis.stability = true", {"analysis.stability": False}),
    ("peak", 'only with analysis.type = "frequency_sweep" or "amplitude_sweep"', {"analysis.type": "forced_response"}),
])
def test_motion_at_refuses_what_is_no_point_of_the_curve(value, part, more):
    message = str(refusal(STOP, {**more, "analysis.motion_at": value}))
    assert "analysis.motion_at" in message and part in message


def test_motion_at_refuses_an_amplitude_that_is_outside():
    assert ("analysis.motion_at = 0.6: 0.6 N is outside the sweep; expected an amplitude from 0.05 to 0.5 N"
            in str(refusal(STOP_AMPLITUDE, {"analysis.motion_at": 0.6})))


AT_ALL = {"frequency_sweep": (STOP, ["peak", "special", 0.18, 0.24]),
          "amplitude_sweep": (STOP_AMPLITUDE, ["peak", "special", 0.05, 0.5])}


@pytest.mark.parametrize("kind, unit, axis, names, tolerance", [
    ("frequency_sweep", "Hz", "frequency", ["0.18Hz_1", "0.18Hz_2", "0.18Hz_3", "0.24Hz"], {"abs": 1e-6}),
    # Motions belong to the balance, turning points to the exact curve.
    ("amplitude_sweep", "N", "amplitude", ["0.05N", "0.5N"], {"rel": 1e-4}),
])
def test_motions_of_a_curve_are_those_of_the_peak_the_folds_and_the_places_given(kind, unit, axis, names, tolerance):
    scene, places = AT_ALL[kind]
    record = solved(scene, {"analysis.motion_at": places})
    summary, motions = record.summary, record.summary["motions"]
    assert record.converged and record.warnings == []
    expected = {f"motion_{name}.csv" for name in ["peak", "fold_1", "fold_2", "grazing_1", *names]}
    assert expected <= files_of(record, ".csv")
    assert highest(record, "motion_peak.csv") == summary["max_displacement_m"]
    assert rows_of(motions) == len(files_of(record, ".csv")) == len(files_of(record, ".svg"))
    column = f"{axis}_{unit}"
    assert list(where(motions, at="peak")[column]) == [summary[f"{axis}_at_max_displacement_{unit}"]]
    folds = where(motions, at="fold")[column]
    assert list(folds) == pytest.approx(summary[f"turning_points_{unit}"], **tolerance)
    assert (motions["residual"] < 1e-9).all()
    if axis == "frequency":
        assert list(where(motions, frequency_Hz=0.18)["unstable_multipliers"]) == [0.0, 1.0, 0.0]


def test_motions_have_the_instants_of_contact_in_the_summary_and_in_their_pictures():
    """A picture shades the contact of the motion of the structure; the force of the balance begins and ends there."""
    record = solved(STOP, {"analysis.motion_at": ["peak", 0.24]})
    assert record.converged and len(files_of(record, ".svg")) == 2
    phases = where(record.summary["phases"], file="motion_peak.csv")
    ((begin,), (end,)) = phases["begin"], phases["end"]
    found = motion(record, "motion_peak.csv")
    since = (found["time_fraction"][found["contact_force_N"] > 0.0] - begin) % 1.0
    assert ((since < end - begin + 0.02) | (since > 1.0 - 0.02)).all()
    figure = figure_of(record, "motion_peak")
    assert "at the peak, " in figure["title"]
    shaded = float(f"{begin:.6g}")  # as many digits as a picture has
    assert [panel["rectangles"][0]["x"][0] for panel in figure["panels"][:3]] == [shaded] * 3
    assert set(record.summary["motions"]["phases_status"]) == {"converged"}


# STOP for the integration from event to event.
MIXTURE = {"mass": np.eye(1), "damping": 0.05 * np.eye(1), "stiffness": np.eye(1), "omega": 2.0 * math.pi * 0.18,
           "load": np.array([0.2]), "contacts": [{"law": "stop", "direction": np.ones(1), "stiffness": 2.0, "gap": 1.0}]}


@pytest.mark.parametrize("scene, at, suffix, displacement", [
    ({**STOP, "analysis": {**STOP["analysis"], "stability": False}}, 0.18, "0.18Hz", 2e-5),
    (STOP_AMPLITUDE, 0.2, "0.2N", 5e-5),
], ids=["frequency", "amplitude"])
def test_motions_at_a_place_are_those_that_close_their_period_near_them(scene, at, suffix, displacement):
    """From the state of a motion Newton's method on the map of a period finds the motion itself, stable or not."""
    record = solved(scene, {"analysis.motion_at": at, "time.functions": 201, "time.quadrature_points": 2048})
    assert record.converged
    tops = []
    for number in (1, 2, 3):
        found = motion(record, f"motion_{suffix}_{number}.csv")
        u, v, force = (found[key][None] for key in ("displacement_m", "velocity_m_per_s", "contact_force_N"))
        near = NearMotion(MIXTURE, u, force, u, v)
        assert near.find() and near.distance() * near.size < displacement
        np.testing.assert_allclose(force, 2.0 * np.maximum(u - 1.0, 0.0), rtol=0.0, atol=1e-12)
        tops.append(u.max())
    if scene["analysis"]["type"] == "frequency_sweep":
        assert tops == sorted(tops, reverse=True) and tops[0] > 1.2 * tops[-1]
    else:
        assert list(record.summary["motions"]["unstable_multipliers"]) == [0.0, 1.0, 0.0]


def test_motions_at_an_amplitude_are_all_those_of_the_closed_form_of_duffings_oscillator():
    """One harmonic, u = a cos: the load is a |1 + 3/4 a^2 - w^2 + i c w|."""
    scene = {**STOP_AMPLITUDE, "contact": {"law": "cubic", "cubic_stiffness": 1.0},
             "forcing": {"amplitude": 0.2, "frequency": 0.25}}
    places = [0.3, 0.7, 2.5]
    record = solved(scene, {**NO_STABILITY, "time.functions": 3, "time.quadrature_points": 16,
                            "analysis.amplitude_to": 3, "analysis.motion_at": places})
    assert record.converged, record.status
    motions = record.summary["motions"]
    detuning, rate = 1.0 - (2.0 * math.pi * 0.25) ** 2, 0.05 * 2.0 * math.pi * 0.25
    for load in places:
        squares = np.roots([9.0 / 16.0, 1.5 * detuning, detuning**2 + rate**2, -(load**2)])
        expected = np.sort(np.sqrt(squares.real[np.abs(squares.imag) < 1e-9]))
        found = where(motions, amplitude_N=load)
        assert list(found["at"]) == ["amplitude"] * len(expected)
        np.testing.assert_allclose(math.sqrt(2.0) * found["rms_displacement_m"], expected, rtol=0.0, atol=1e-8)
    assert rows_of(motions) == 7  # three, three and one


def test_motions_of_matrices_hold_every_contact_and_the_whole_structure():
    record = solved(CHAIN, {**NO_STABILITY, "analysis.type": "frequency_sweep", "analysis.frequency_from": 40,
                            "analysis.frequency_to": 48, "time.functions": 31, "analysis.motion_at": "peak",
                            "analysis.motion_points": 16})
    assert record.converged, record.status
    folder = folder_of(record)
    assert len(motion(record, "motion_peak_contacts.csv")["contact"]) == 2 * 1024
    assert "\n3 16\n" in (folder / "motion_peak.mtx").read_text()
    assert "motion_peak.mtx</a>: motion of the curve at the peak, " in (folder / "report.html").read_text()
    (place,) = record.summary["motions"]["frequency_Hz"]
    again = solved(CHAIN, {"time.functions": 31, "forcing.frequency": place},
                   start_from=folder / "motion_peak_contacts.csv")
    assert again.converged and again.summary["contacts"] == 2


WHOLE = [("frequency_sweep", "frequency", (40, 48), [41, 43, 44, 45, 46, 47.5], "Hz", 6),
         ("amplitude_sweep", "amplitude", (20, 400), [30, 100, 200, 350], "N", 4)]


@pytest.mark.parametrize("kind, axis, ends, places, unit, least", WHOLE, ids=["frequency", "amplitude"])
def test_motions_of_the_whole_structure_move_its_contacts_as_the_contacts_move(kind, axis, ends, places, unit, least):
    """The structure is recovered at the place of the motion, wherever the search for it ended."""
    record = solved(CHAIN, {**NO_STABILITY, "analysis.type": kind, f"analysis.{axis}_from": ends[0],
                            f"analysis.{axis}_to": ends[1], "analysis.motion_at": places, "time.functions": 31,
                            "analysis.motion_points": 16, "analysis.output_points": 16})
    assert record.converged, record.status
    files = files_of(record, ".mtx")
    assert len(files) >= least and all(unit in file for file in files)
    for file in files:
        whole = np.asarray(scipy.io.mmread(folder_of(record) / file))
        contacts = motion(record, file.replace(".mtx", "_contacts.csv"))
        for contact in (1, 2):
            expected = contacts["displacement_m"][contacts["contact"] == contact]
            assert len(expected) == 16
            assert np.linalg.norm(whole[contact] - expected) < 1e-6 * np.linalg.norm(expected)


def test_motions_of_several_periods_of_the_load_have_the_loads_frequency():
    once = solved(STOP, {"analysis.motion_at": 0.24})
    twice = solved(STOP, {**NO_STABILITY, "analysis.motion_at": 0.24, "analysis.subharmonic": 2, "time.functions": 125,
                          "time.quadrature_points": 2048, "analysis.output_points": 2048})
    u, v = (motion(record, "motion_0.24Hz.csv")["displacement_m"] for record in (once, twice))
    np.testing.assert_allclose(v, np.tile(u, 2), rtol=0.0, atol=1e-9)
    assert list(twice.summary["motions"]["frequency_Hz"]) == [0.24]


def test_a_curve_warns_of_a_frequency_that_it_does_not_reach():
    record = solved(STOP, {"analysis.motion_at": 0.24, "analysis.max_points": 5})
    assert not record.converged and rows_of(record.summary["motions"]) == 0
    assert warns(record, "does not reach 0.24 Hz")
