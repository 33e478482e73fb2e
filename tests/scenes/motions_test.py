"""All motions at one frequency: the record of motions found, and of unsolved ones."""

import math

import pytest


def tapping(structure, tmp_path, points):
    """A cantilever that taps on a sample, attraction and Hertz contact, as a table of so many points."""
    stiffness, frequency, quality, free = 2.0, 70e3, 150.0, 20e-9
    omega = 2 * math.pi * frequency
    mass = stiffness / omega**2
    distance, touch = 15e-9, 0.165e-9

    def force(u):
        d = distance - u
        return (-6.4e-20 * 10e-9 / 6 / max(d, touch) ** 2
                + 4 / 3 * 1.3e9 * math.sqrt(10e-9) * max(touch - d, 0.0) ** 1.5)

    places = [-40e-9 + 54.8e-9 * i / (points // 3) for i in range(points // 3)]
    places += [14.8e-9 + 3.2e-9 * i / points for i in range(points)]
    (tmp_path / "sample.csv").write_text(
        "u_m,force_N\n" + "".join(f"{u:.12e},{force(u):.12e}\n" for u in places))
    return (structure(mass, stiffness, mass * omega / quality)
            + f"""contact_dofs = [1]
[contact]
law = "table"
table = "sample.csv"
[forcing]
load_dofs = [1]
amplitude = {stiffness * free / quality}
frequency = {frequency}
[analysis]
type = "motions"
random_starts = 0
""")


def test_the_motion_of_a_law_of_many_pieces_is_solved_for(run, structure, tmp_path):
    """A table of 1500 points has too many phases for their equations; the flow passes from piece to piece."""
    record = run(tapping(structure, tmp_path, 1500))
    assert record.code == 0, record.errors
    (motion,) = record.summary["motions"]
    assert motion["period"] == 1 and motion["stability"] == "stable"
    assert motion["max_displacement_m"] == pytest.approx(16.1378e-9, rel=1e-4)  # of an integration in time


def test_the_box_of_random_states_follows_the_law(run, structure):
    """A cubic spring moves the resonance to 2.5 rad/s, where the response without contact is small."""
    record = run(structure(1.0, 1.0, 0.1) + f"""contact_dofs = [1]
[contact]
law = "cubic"
cubic_stiffness = 1.0
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = {2.5 / (2 * math.pi)}
[analysis]
type = "motions"
random_starts = 4
""")
    stable = [one for one in record.summary["motions"] if one["stability"] == "stable"]
    assert max(one["max_displacement_m"] for one in stable) == pytest.approx(2.76813, rel=1e-5)
    assert sum(one["share"] for one in stable) == pytest.approx(1.0)
    (side,) = record.summary["start_box"]
    # Twice the amplitude at which 1 + 3/4 a^2 is the square of 2.5 rad/s.
    assert side["largest_displacement_m"] == pytest.approx(2 * math.sqrt(4 / 3 * (2.5**2 - 1)), rel=0.3)
    assert side["largest_velocity_m_per_s"] == pytest.approx(2.5 * side["largest_displacement_m"])


def test_a_detached_curve_that_the_law_moves_away_is_found(run, absorber):
    """An absorber, whose spring to the ground gives a shape that no mode has [T. Detroux, G. Habib, L. Masset, G.
    Kerschen, MSSP, 2015]."""
    record = run(absorber([[1.0453, -0.0453], [-0.0453, 0.0453]], [[0.015, -0.013], [-0.013, 0.013]], """law = "cubic"
[[contact.pairs]]
dofs = [1]
cubic_stiffness = 1.0
[[contact.pairs]]
dofs = [1, 2]
cubic_stiffness = 0.0042""", 0.18, """frequency_from = 0.27
frequency_to = 0.31
isolas = true
isola_spacing = 0.04
isola_starts = 1"""))
    assert record.code == 0, record.errors
    point, = record.summary["special_points_of_isolas"]
    assert point["type"] == "neimark_sacker"
    assert point["frequency_Hz"] == pytest.approx(0.27943606, rel=1e-6)  # motion of the curve followed from above
    parts = {part["isola"]: part for part in record.summary["unstable_parts"]}
    assert parts[1]["end_Hz"] == pytest.approx(point["frequency_Hz"])
    assert parts[2]["end_Hz"] - parts[2]["begin_Hz"] == pytest.approx(0.04)
    assert "Along isola 2 motions are unstable at 0.27 to 0.31 Hz." in record.page


STOPS = """contact_dofs = [1]
[contact]
law = "rigid"
gap = {gap}
restitution = {restitution}
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = {frequency}
[[forcing.terms]]
harmonic = 0
amplitude = {static}
dofs = [1]
[analysis]
type = "motions"
random_starts = 3
"""


def test_the_motion_in_which_a_contact_that_bounces_rests_is_among_those_found(run, structure):
    """Pressed against its stop for half of the period, every start bounces ever faster."""
    scene = structure(1.0, 1.0, 0.1) + STOPS.format(gap=1.0, restitution=0.5, frequency=0.02, static=0.5)
    record = run(scene)
    assert record.code == 0, record.errors
    (motion,) = record.summary["motions"]
    assert motion["stability"] == "stable" and motion["max_contact_force_N"] > 0.0


def test_random_starts_of_friction_between_rigid_stops_settle_to_one_motion(run, scenes):
    record = run(scenes / "cases_of_others" / "spool_valve.toml", "--analysis", "motions", "--set", "analysis.random_starts=8")
    assert record.code == 0, record.errors
    (motion,) = record.summary["motions"]
    assert motion["found_by"] == "rest" and motion["stability"] == "stable" and motion["share"] > 0.5
    assert "by event-driven integration over a period" in (record.folder / "report.html").read_text()
    assert (record.folder / "motion_1_impacts.csv").exists()


def test_where_a_body_is_that_nothing_holds_makes_no_other_motion(run, scenes):
    record = run(scenes / "cases_of_others" / "shaken_mass.toml", "--analysis", "motions", "--set", "analysis.random_starts=4",
                 "--set", "forcing.frequency=1.0")
    assert record.code == 0, record.errors
    (motion,) = record.summary["motions"]
    assert motion["stability"] == "on_unit_circle" and motion["share"] == 1.0
