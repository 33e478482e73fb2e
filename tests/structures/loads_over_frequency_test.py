"""Loads that vary with the frequency: amplitude_table, accelerations in g, and normal loads that grow or follow a table."""

import os

import numpy as np
import pytest
import scipy.interpolate
from structure_scenes import displacements, distance, refused, terms

import wavebalance as wb

MASS, STIFFNESS, DAMPING = 2.0, 8e3, 6.0  # kg, N/m, N s/m
SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = [1]
[contact]
{contact}
[forcing]
frequency = 9.0
{terms}
[time]
{time}
[analysis]
{analysis}
"""
BASES = 'trial = "fourier"\nweight = "fourier"\nfunctions = 31'
SWEEP = 'type = "frequency_sweep"\nfrequency_from = 6.0\nfrequency_to = 14.0'
RESPONSE = 'type = "forced_response"'
STOP = 'law = "linear"\nstiffness = 3e3\ngap = 2e-4'
PLACES, AMPLITUDES, PHASES = [5.0, 8.0, 11.0, 15.0], [3.0, 5.0, 2.0, 4.0], [0.0, 40.0, -30.0, 10.0]


@pytest.fixture(autouse=True)
def matrices(matrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, value in (("m", MASS), ("k", STIFFNESS), ("c", DAMPING)):
        matrix(f"{name}.mtx", [[value, 0.0], [0.0, value]])
    table("table.csv")
    table("loads.csv", amplitudes=LOADS, head="frequency_Hz,normal_load")


def table(name, places=PLACES, amplitudes=AMPLITUDES, phases=None, head="frequency_Hz,amplitude"):
    columns = [places, amplitudes] + ([] if phases is None else [phases])
    lines = [head + ("" if phases is None else ",phase_degrees")] + [",".join(map(repr, row)) for row in zip(*columns)]
    with open(name, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


FILES = [("table.csv", "amplitude"), ("loads.csv", "normal_load")]


def scene(*each, contact='law = "none"', time=BASES, analysis=RESPONSE):
    return SCENE.format(contact=contact, terms=terms(*each), time=time, analysis=analysis)


def solved(*arguments, overrides=None, unset=(), **named):
    record = wb.run(scene(*arguments, **named), overrides, unset=unset)
    assert record.converged, record.status
    return record


def steffen(places, values):
    """Monotone cubics with a continuous slope [M. Steffen, Astron. Astrophys. 239, 1990]."""
    width, slope = np.diff(places), np.diff(values) / np.diff(places)
    middle = (slope[:-1] * width[1:] + slope[1:] * width[:-1]) / (width[:-1] + width[1:])
    least = np.minimum(np.minimum(np.abs(slope[:-1]), np.abs(slope[1:])), 0.5 * np.abs(middle))
    inner = (np.sign(slope[:-1]) + np.sign(slope[1:])) * least
    return scipy.interpolate.CubicHermiteSpline(places, values, np.r_[slope[0], inner, slope[-1]])


def force_at(frequency, phases=None, amplitude=1.0):
    """The complex amplitude of the table."""
    values = np.array(AMPLITUDES) * np.exp(1j * np.radians(phases if phases is not None else np.zeros(4)))
    return amplitude * (steffen(PLACES, values.real)(frequency) + 1j * steffen(PLACES, values.imag)(frequency))


def receptance(frequency):
    omega = 2.0 * np.pi * frequency
    return 1.0 / (STIFFNESS - MASS * omega**2 + 1j * omega * DAMPING)


TABLE = 'dofs = [1]\namplitude_table = "table.csv"'


# amplitude_table of [forcing].
PLAIN = SCENE.replace("frequency = 9.0", "frequency = 9.0\nload_dofs = [1]\namplitude = 2.5\namplitude_table = \"table.csv\"")


def plain(**named):
    return PLAIN.format(**{"contact": 'law = "none"', "terms": "", "time": BASES, "analysis": RESPONSE} | named)


@pytest.mark.parametrize("exact", ["false", "true"])
@pytest.mark.parametrize("phases", [None, PHASES])
@pytest.mark.parametrize("amplitude, written", [
    (1.0, lambda **named: scene(TABLE + "\namplitude = 1.0", **named)),
    (2.5, lambda **named: scene(TABLE + "\namplitude = 2.5", **named)),
    (2.5, plain),
], ids=["term", "larger term", "forcing"])
def test_a_curve_has_the_amplitude_of_the_table_at_each_point(exact, phases, amplitude, written):
    table("table.csv", phases=phases)
    record = wb.run(written(analysis=SWEEP + f"\nexact = {exact}\nstability = true", contact=STOP.replace("2e-4", "1.0")))
    assert record.converged, record.status
    frequency = record.sweep["frequency_Hz"]
    assert len(frequency) > 10
    expected = np.abs(receptance(frequency) * force_at(frequency, phases, amplitude)) / np.sqrt(2.0)
    np.testing.assert_allclose(record.sweep["rms_displacement_m"], expected, rtol=1e-9)
    assert not record.sweep["unstable"].any()


@pytest.mark.parametrize("kind, unit", [("unbalance", lambda omega: omega**2), ("base_acceleration", lambda omega: -MASS)])
def test_the_table_is_a_factor_on_loads_of_every_kind(kind, unit):
    record = solved(f'kind = "{kind}"\n' + TABLE + "\namplitude = 1e-3", analysis=SWEEP)
    frequency = record.sweep["frequency_Hz"]
    load = unit(2.0 * np.pi * frequency) * force_at(frequency, amplitude=1e-3)
    np.testing.assert_allclose(record.sweep["rms_displacement_m"], np.abs(receptance(frequency) * load) / np.sqrt(2.0), rtol=1e-9)


def test_points_with_a_stop_are_responses_to_the_amplitude_there():
    table("table.csv", phases=PHASES)
    for exact, apart in (("false", 1e-9), ("true", 1e-8)):
        sweep = solved(TABLE, contact=STOP, analysis=SWEEP + f"\nexact = {exact}").sweep
        touching = np.flatnonzero(sweep["max_contact_force_N"] > 0.5)
        for point in touching[[len(touching) // 3, -len(touching) // 3]]:
            at = float(sweep["frequency_Hz"][point])
            load = force_at(at, PHASES)
            term = f"dofs = [1]\namplitude = {abs(load)!r}\nphase = {np.degrees(np.angle(load))!r}"
            time = 'method = "exact"' if exact == "true" else BASES
            response = solved(term, contact=STOP, time=time, overrides={"forcing.frequency": at}).summary
            assert sweep["max_displacement_m"][point] == pytest.approx(response["max_displacement_m"], rel=apart)


def test_time_stepping_and_a_study_take_the_amplitude_at_their_frequency(tmp_path):
    stepped = solved(TABLE, time="", analysis='type = "time_stepping"\ntolerance = 1e-9', contact=STOP)
    balance = solved(f"dofs = [1]\namplitude = {force_at(9.0).real!r}", time='method = "exact"', contact=STOP)
    assert stepped.summary["max_displacement_m"] == pytest.approx(balance.summary["max_displacement_m"], rel=1e-7)
    values = [6.5, 9.0, 12.0]
    found = wb.study(scene(TABLE), {"forcing.frequency": values}, output=tmp_path / "study").table["rms_displacement_m"]
    np.testing.assert_allclose(found, [abs(receptance(one) * force_at(one)) / np.sqrt(2.0) for one in values], rtol=1e-9)


def test_an_acceleration_in_g_is_one_in_si_units(tmp_path):
    base = 'kind = "base_acceleration"\ndofs = [1, 2]\n'
    in_g = wb.run(scene(base + 'amplitude = 0.3\nunit = "g"'), output=tmp_path / "g")
    assert distance(displacements(in_g), displacements(solved(base + f"amplitude = {0.3 * 9.80665!r}"))) < 1e-14
    assert "0.3 g" in wb.check(scene(base + 'amplitude = 0.3\nunit = "g"'))
    assert distance(displacements(wb.run(tmp_path / "g" / "scene.toml")), displacements(in_g)) == 0.0
    sweep = 'type = "amplitude_sweep"\namplitude_from = 0.1\namplitude_to = 0.3'
    record = solved(base + 'amplitude = 0.3\nunit = "g"', analysis=sweep)
    assert record.sweep["amplitude_g"][-1] == 0.3
    assert record.sweep["max_displacement_m"][-1] == pytest.approx(in_g.summary["max_displacement_m"], rel=1e-9)


def test_a_scene_is_written_with_its_table(tmp_path):
    first = wb.run(scene(TABLE + "\namplitude = 2.0"), output=tmp_path / "out")
    assert distance(displacements(wb.run(tmp_path / "out" / "scene.toml")), displacements(first)) == 0.0
    assert "2 N times a table over the frequency" in wb.check(scene(TABLE + "\namplitude = 2.0"))


@pytest.mark.parametrize("term, key", [
    (TABLE + "\nharmonic = 0", "forcing.terms[1].amplitude_table"),
    ('dofs = [1]\namplitude = 1.0\nunit = "g"', "forcing.terms[1].unit"),
])
def test_a_key_that_does_not_belong_to_the_term_is_refused(term, key):
    refused(scene(term), key)


# A slider on the first mass, whose normal load grows with the square of the frequency, or by a table in addition to a
# constant one.
MU, TANGENTIAL, GROWTH, LOAD = 0.4, 2e4, 6.5e-3, 1.0
LOADS = [3.0, 20.0, 6.0, 12.0]
PRESSED = f'law = "coulomb"\nfriction = {MU}\ntangential_stiffness = {TANGENTIAL}\nnormal_load = '
GROWING = PRESSED + f"{LOAD}\nnormal_load_speed2 = {GROWTH}"
TABLED = PRESSED + f"{LOAD}\nnormal_load_table = \"loads.csv\""
DRIVE = "dofs = [1]\namplitude = 12.0"
FINE = BASES.replace("31", "63") + "\nquadrature_points = 512"


def normal_load(frequency):
    return LOAD + GROWTH * (2.0 * np.pi * frequency)**2


def tabled(frequency):
    return float(LOAD + steffen(PLACES, np.array(LOADS))(frequency))


def at(frequency, load, time=FINE, keys=None):
    """The response at a frequency under a normal load that is given."""
    return solved(DRIVE, contact=PRESSED + repr(load), time=time, overrides={"forcing.frequency": frequency, **(keys or {})})


varies = pytest.mark.parametrize("contact, load", [(GROWING, normal_load), (TABLED, tabled)], ids=["growing", "tabled"])


@varies
@pytest.mark.parametrize("time", [FINE, 'method = "exact"', "stepping"])
def test_a_response_has_the_normal_load_at_its_frequency(contact, load, time):
    stepping = time == "stepping"
    named = {"time": "" if stepping else time, "analysis": 'type = "time_stepping"' if stepping else RESPONSE}
    found = solved(DRIVE, contact=contact, **named)
    given = solved(DRIVE, contact=PRESSED + repr(load(9.0)), **named)
    assert distance(displacements(found), displacements(given)) < 1e-10
    assert found.summary["friction_work_J"] == pytest.approx(given.summary["friction_work_J"], rel=1e-9)
    assert given.summary["friction_work_J"] > 0.0


@varies
@pytest.mark.parametrize("exact", ["false", "true"])
def test_points_of_a_curve_are_responses_under_the_normal_load_there(contact, load, exact):
    stable = f"\nexact = {exact}\nstability = true"
    sweep = solved(DRIVE, contact=contact, time=FINE, analysis=SWEEP + stable).sweep
    frequency = sweep["frequency_Hz"]
    assert len(frequency) > 10
    slips = np.flatnonzero(sweep["slip_fraction"] > 0.05) if "slip_fraction" in sweep else np.arange(len(frequency))
    for point in slips[[0, len(slips) // 2, -1]]:
        one = float(frequency[point])
        beginning = f'type = "frequency_sweep"\nfrequency_from = {one!r}\nfrequency_to = {1.01 * one!r}'
        fixed = solved(DRIVE, contact=PRESSED + repr(load(one)), time=FINE, analysis=beginning + stable).sweep
        assert fixed["frequency_Hz"][0] == one
        for name in ("max_displacement_m", "friction_work_J"):
            if name in sweep:
                assert sweep[name][point] == pytest.approx(fixed[name][0], rel=1e-6)
        assert sweep["unstable"][point] == fixed["unstable"][0]


def test_the_first_slip_is_where_the_spring_force_is_the_limit_at_its_frequency():
    record = solved(DRIVE, contact=GROWING, time=FINE, analysis=SWEEP)
    points = record.summary["special_points"]
    slips = points["frequency_Hz"][np.isin(points["type"], ["slip"])]
    assert len(slips) > 0
    for one in slips:
        omega = 2.0 * np.pi * one
        stuck = 12.0 / abs(STIFFNESS + TANGENTIAL - MASS * omega**2 + 1j * omega * DAMPING)
        assert TANGENTIAL * stuck == pytest.approx(MU * normal_load(one), rel=1e-4)


@varies
def test_a_study_and_a_diagram_have_the_normal_load_of_each_frequency(contact, load, tmp_path):
    values = [8.0, 10.0]
    found = wb.study(scene(DRIVE, contact=contact, time=FINE), {"forcing.frequency": values}, output=tmp_path / "study").table
    expected = [at(one, load(one)).summary["rms_displacement_m"] for one in values]
    np.testing.assert_allclose(found["rms_displacement_m"], expected, rtol=1e-9)
    diagram = 'type = "bifurcation_diagram"\nfrequency_from = 8.0\nfrequency_to = 10.0\nvalues = 2\nexact_curve = false\nboth_ways = false'
    section = wb.run(scene(DRIVE, contact=contact, time="", analysis=diagram)).section
    fixed = wb.run(scene(DRIVE, contact=PRESSED + repr(load(10.0)), time="", analysis=diagram)).section
    assert section["displacement_m"][-1] == pytest.approx(fixed["displacement_m"][-1], rel=1e-6)


def test_a_motion_of_the_curve_has_the_normal_load_at_its_frequency(tmp_path):
    wb.run(scene(DRIVE, contact=GROWING, time=FINE, analysis=SWEEP + "\nmotion_at = [9.0]"), output=tmp_path)
    found = np.genfromtxt(tmp_path / "motion_9Hz.csv", delimiter=",", names=True)["displacement_m"]
    assert np.ptp(found) == pytest.approx(np.ptp(displacements(at(9.0, normal_load(9.0)))[0]), rel=1e-4)


@pytest.mark.parametrize("time, analysis", [
    (BASES, RESPONSE), ('method = "exact"', RESPONSE), ("", 'type = "time_stepping"\ntolerance = 1e-9'),
    ("", 'type = "shooting"'), ("", 'type = "motions"'),
    ("", 'type = "bifurcation_diagram"\nfrequency_from = 8.9\nfrequency_to = 9.0\nvalues = 2\nboth_ways = false'),
])
def test_both_tables_are_the_same_load_in_every_analysis(time, analysis):
    one = wb.run(plain(time=time, analysis=analysis, contact=STOP))
    other = wb.run(scene(TABLE + "\namplitude = 2.5", time=time, analysis=analysis, contact=STOP))
    assert one.converged and other.converged
    if "bifurcation" in analysis:
        given = wb.run(scene(f"dofs = [1]\namplitude = {force_at(9.0, amplitude=2.5).real!r}", time=time, analysis=analysis, contact=STOP))
        for record in (one, other):
            assert record.section["displacement_m"][-1] == pytest.approx(given.section["displacement_m"][-1], rel=1e-6)
    else:
        assert one.summary["max_displacement_m"] == pytest.approx(other.summary["max_displacement_m"], rel=1e-9)


def test_a_bar_takes_a_table_and_a_scene_is_written_with_it(tmp_path):
    bar = """
[structure]
type = "bar"
youngs_modulus = 1.0
density = 1.0
area = 1.0
length = 1.0
elements = 4
stiffness_damping = 0.1
[contact]
law = "none"
[forcing]
amplitude = 0.1
frequency = 9.0
{table}
[time]
{time}
"""
    record = wb.run(bar.format(table='amplitude_table = "table.csv"', time=BASES), output=tmp_path / "out")
    given = wb.run(bar.format(table="", time=BASES), {"forcing.amplitude": 0.1 * force_at(9.0).real})
    assert distance(displacements(record), displacements(given)) < 1e-12
    assert distance(displacements(wb.run(tmp_path / "out" / "scene.toml")), displacements(record)) == 0.0
    assert "100 mN times a table over the frequency" in wb.check(bar.format(table='amplitude_table = "table.csv"', time=BASES))


TABLES = {  # of which a sweep is refused at these keys
    "forcing.terms[1].amplitude_table": lambda **named: scene(TABLE, **named),
    "forcing.amplitude_table": plain,
    "contact.normal_load_table": lambda **named: scene(DRIVE, contact=TABLED, **named),
}


@pytest.mark.parametrize("key, prepare, part", [
    *((key, lambda: [table(name, [7.0, 8.0, 11.0, 15.0], head=f"frequency_Hz,{head}") for name, head in FILES], "6 to 14 Hz")
      for key in TABLES),
    ("forcing.terms[1].amplitude_table", lambda: table("table.csv", places=[5.0, 8.0, 8.0, 15.0]), "not above"),
    ("forcing.terms[1].amplitude_table", lambda: table("table.csv", head="frequency,amplitude"), "frequency_Hz"),
    ("forcing.terms[1].amplitude_table", lambda: table("table.csv", places=[5.0], amplitudes=[1.0]), "at least 2"),
    ("forcing.amplitude_table", lambda: table("table.csv", amplitudes=[1.0, float("nan"), 1.0, 1.0]), "no finite number"),
    ("forcing.amplitude_table", lambda: os.remove("table.csv"), "table.csv"),
    ("contact.normal_load_table", lambda: table("loads.csv", amplitudes=[1.0, -2.0, 1.0, 1.0], head="frequency_Hz,normal_load"), "at least 0"),
    ("contact.normal_load_table", lambda: table("loads.csv", head="frequency_Hz,load"), "normal_load"),
    ("contact.normal_load_table", lambda: os.remove("loads.csv"), "loads.csv"),
])
def test_a_table_that_does_not_fit_is_refused_by_key(key, prepare, part):
    prepare()
    assert part in str(refused(TABLES[key](analysis=SWEEP), key))


def test_a_table_of_an_amplitude_of_zero_is_refused():
    assert "which is 0" in str(refused(plain(), "forcing.amplitude_table", overrides={"forcing.amplitude": 0.0}))


@pytest.mark.parametrize("key", ["forcing.terms[1].amplitude_table", "forcing.amplitude_table"])
def test_an_amplitude_sweep_takes_no_table(key):
    sweep = 'type = "amplitude_sweep"\namplitude_from = 0.1\namplitude_to = 0.3'
    refused(TABLES[key](analysis=sweep), key, "amplitude alone")


def test_a_limit_cycle_has_no_frequency_for_a_normal_load_to_follow():
    cycle = scene(contact=GROWING + "\nsurface_speed = 0.1", time="", analysis='type = "limit_cycle"').replace("frequency = 9.0", "")
    refused(cycle, "contact.normal_load_speed2", "normal_load alone")
