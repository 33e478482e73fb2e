"""Records and report pages of motions and curves, beginning with the vibration."""

import csv
import html
import json
import os
import re
import signal
import subprocess
import time

import pytest

PAIR = """
[structure]
type = "matrices"
mass = "mass.mtx"
stiffness = "stiffness.mtx"
stiffness_damping = 0.02

[contact]
law = "coulomb"
friction = 0.3
tangential_stiffness = 2.0
normal_stiffness = 50.0
normal_load = 1.0

[[contact.pairs]]
dofs = [2]
tangent = [1]

[[contact.pairs]]
dofs = [4]
tangent = [3]

[forcing]
load_dofs = [1, 3]
amplitude = 0.5
frequency = 0.12

[[forcing.terms]]
harmonic = 0
amplitude = 1.0
dofs = [2, 4]

[time]
trial = "fourier"
weight = "fourier"
functions = 31
quadrature_points = 256

[analysis]
type = "forced_response"
contact_outputs = true
outputs = [1]
"""


@pytest.fixture
def two_contacts(matrix):
    """A scene of two masses that slide along x and are pressed on an obstacle along y."""
    matrix("mass.mtx", [[float(i == j) for j in range(4)] for i in range(4)])
    matrix("stiffness.mtx", [[1.0, 0, -0.2, 0], [0, 3.0, 0, 0], [-0.2, 0, 1.2, 0], [0, 0, 0, 3.0]])
    return PAIR


def sentences(page):
    """The page's text without markup."""
    return html.unescape(re.sub(r"<[^>]+>", " ", page))


def rows_of(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def svg_text(file):
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", file.read_text()))


def test_contacts_have_one_number_each_in_all_files(run, command, two_contacts):
    record = run(two_contacts)
    summary = record.summary
    assert (summary["contacts"], summary["contact_directions"]) == (2, 4)
    assert {row["contact"] for row in summary["friction"]} == {1, 2}
    assert {row["contact"] for row in summary["phases"]} == {1, 2}
    assert [row["direction"] for row in summary["at_rest"]] == ["normal", "tangent"] * 2
    outputs = [row["output"] for row in summary["outputs"]]
    assert outputs == ["row 1", "contact 1 normal", "contact 1 tangent", "contact 2 normal", "contact 2 tangent"]
    contacts = rows_of(record.folder / "contacts.csv")
    assert {(row["contact"], row["direction"]) for row in contacts} == {
        (number, direction) for number in "12" for direction in ("normal", "tangent")}
    assert "At rest under the static loads 2 of 2 contacts are closed" in sentences(record.page)
    checked = command("check", "scene.toml").text
    assert "at 2 contacts" in checked and "2 of 2 contacts are closed" in checked


def test_a_record_with_directions_is_a_start(run, command, two_contacts):
    run(two_contacts)
    again = command("run", "scene.toml", "--output", "again", "--start-from", "out")
    assert again.code == 0, again.errors


def test_friction_is_told_by_its_states_and_by_what_vibrates(run, two_contacts):
    record = run(two_contacts)
    page, summary = sentences(record.page), record.summary
    assert "Contact lasts" not in page
    assert "Contact 1 sticks for" in page and "is open for 0 %" in page
    assert summary["contact_fraction"] == 1.0
    assert summary["leading_direction"] == "tangent"
    assert summary["vibration_m"] > 1e-3
    assert page.index("The vibration of row 1") < page.index("the displacement of contact")
    title = svg_text(record.folder / "response.svg")
    assert "Motion of row 1" in title and "State of each contact" in title


def test_a_slider_that_never_opens_is_closed_all_the_time(run, scenes):
    record = run(scenes / "friction" / "slider.toml")
    assert record.summary["contact_fraction"] == 1.0
    assert "Contact 1 sticks for 28.7 % of the period, slips for 71.3 %" in sentences(record.page)
    assert "shaded" not in svg_text(record.folder / "response.svg")


def test_contacts_that_stick_wear_nothing(run, scenes):
    stuck = run(scenes / "friction" / "slider.toml", set=("contact.normal_load=1000", "contact.wear_coefficient=1e-12"))
    assert stuck.summary["wear_m3"] == 0.0
    assert stuck.summary["friction_work_J"] == 0.0


def test_springs_that_act_everywhere_have_no_share_of_contact(run, scenes):
    record = run(scenes / "laws" / "duffing.toml")
    assert record.summary["contact_fraction"] is None
    page = sentences(record.page)
    assert "Contact lasts" not in page and "No contact closes" not in page
    assert "at 0.2318" in page  # the peak, with the digits that the points determine


def test_curves_with_impacts_show_what_vibrates_and_all_keys(run, scenes):
    record = run(scenes / "impacts" / "oscillator.toml", "--analysis", "frequency_sweep",
                 set=("analysis.frequency_from=0.14", "analysis.frequency_to=0.2"))
    summary = record.summary
    assert summary["warnings"] == []
    assert summary["vibration_m"] > summary["rms_vibration_m"] > 0.5
    assert summary["max_impact_velocity_m_per_s"] > 1.0
    picture = svg_text(record.folder / "sweep.svg")
    assert "Vibration (m)" in picture and "Speeds of impacts" in picture and "Displacement" not in picture
    assert "largest displacement" not in sentences(record.page)
    vibrations = {float(row["vibration_m"]) for row in rows_of(record.folder / "sweep.csv")}
    assert len(vibrations) > 3


def test_unstable_parts_of_exact_curves_end_at_their_folds(run, scenes):
    record = run(scenes / "jones_legrand_2014" / "case2_sweep.toml", set=("analysis.exact=true",))
    summary, page = record.summary, sentences(record.page)
    folds = [row["frequency_Hz"] for row in summary["special_points"] if row["type"] == "fold"]
    part = summary["unstable_parts"][0]
    assert [part["begin_Hz"], part["end_Hz"]] == pytest.approx(folds, abs=1e-9)
    assert "Error of the vibration" not in page and "rms error" not in page
    picture = svg_text(record.folder / "sweep.svg")
    assert "exact periodic solutions" in picture and "Fourier" not in picture and "functions" not in picture


def test_one_point_of_unknown_stability_does_not_name_the_whole_curve(run, scenes):
    record = run(scenes / "jones_legrand_2014" / "case2_sweep.toml")
    summary = record.summary
    left = summary["points_stability_not_known"]
    assert 0 < left < 10
    assert (summary["stability"], summary["stability_not_known"]) == ("partly_known", "too_few_samples")
    page = sentences(record.page)
    assert f"Stability is known at {summary['points'] - left} of {summary['points']} points" in page
    part = summary["unstable_parts"][0]
    assert [part["begin_Hz"], part["end_Hz"]] == pytest.approx([1337.739, 1315.015], abs=2e-3)


def test_friction_beyond_the_states_that_are_followed_says_so(run, scenes):
    scene = scenes / "friction" / "bolted_beam.toml"
    assert run(scene).summary["points_stability_not_known"] == 0  # by its slow modes
    page = sentences(run(scene, set=("structure.stiffness_damping=1e-10",)).page)  # fast modes ring on
    assert "with friction it requires all 246 states of the structure, and at most 120 are supported" in page


def test_errors_are_given_for_the_vibration_and_each_output(run, two_contacts):
    record = run(two_contacts.replace("dofs = [2, 4]", "dofs = [2, 4]\n\n[[forcing.terms]]\nharmonic = 0\namplitude = 5.0\ndofs = [1]"))
    summary = record.summary
    assert summary["error_of_vibration"] < 1e-2
    assert all(row["error_of_vibration"] < 0.05 for row in summary["outputs"] if "normal" not in row["output"])
    page = sentences(record.page)
    assert "Error of the vibration against the nearest exact periodic solution found: row 1" in page
    assert page.index("Error of the vibration") < page.index("relative rms error")


def test_the_peak_of_a_curve_has_errors_too(run, scenes):
    record = run(scenes / "jones_legrand_2014" / "case2_sweep.toml", set=("analysis.outputs=[25]",))
    summary = record.summary
    assert summary["error_of_vibration"] < 1e-3
    output = next(row for row in summary["outputs"] if row["output"] == "node 25")
    assert output["error_at_peak"] == pytest.approx(summary["error_of_vibration"], rel=1e-3)


def test_the_period_begins_between_two_contacts(run, scenes):
    record = run(scenes / "jones_legrand_2014" / "case1.toml")
    script = (record.folder / "response.figure.js").read_text()
    figure = json.loads(script[script.index('] = {') + 4:script.rindex("}") + 1])
    spans = [span["x"] for span in figure["panels"][0]["rectangles"]]
    assert len(spans) == 1 and spans[0][0] < 0.0 < spans[0][1]


def test_an_open_contact_is_told_by_its_distance(run, matrix):
    matrix("one.mtx", [[1.0]])
    record = run("""
[structure]
type = "matrices"
mass = "one.mtx"
stiffness = "one.mtx"
contact_dofs = [1]
stiffness_damping = 0.1
[contact]
law = "linear"
stiffness = 10.0
gap = 0.0199999
[forcing]
load_dofs = [1]
amplitude = 0.01
frequency = 0.112
[time]
trial = "fourier"
weight = "fourier"
functions = 15
quadrature_points = 64
[analysis]
type = "forced_response"
""", set=("contact.gap=0.02",))
    highest = record.summary["max_displacement_m"]
    warning = next(one for one in record.summary["warnings"] if "No contact closes" in one)
    assert "the nearest stays" in warning
    assert highest < 0.02


def test_points_of_an_interrupted_curve_are_solutions_with_their_outputs(scenes, tmp_path):
    arguments = [os.environ["WAVEBALANCE_COMMAND"], "run", scenes / "jones_legrand_2014" / "case2_sweep.toml", "--output",
                 tmp_path / "out"]
    for pair in ("analysis.outputs=[25]", "analysis.largest_step=0.01", "analysis.first_step=0.01"):
        arguments += ["--set", pair]
    for seconds in (0.5, 2.0, 8.0):  # on a busy machine the first point is slower
        with subprocess.Popen([str(one) for one in arguments], stderr=subprocess.PIPE, stdout=subprocess.PIPE) as program:
            time.sleep(seconds)
            program.send_signal(signal.SIGINT)
            program.communicate(timeout=60)
        if (tmp_path / "out" / "sweep.csv").exists():
            break
    rows = rows_of(tmp_path / "out" / "sweep.csv")
    assert len(rows) > 10
    assert all(row["node_25_half_peak_to_peak_m"] for row in rows)
    page = sentences((tmp_path / "out" / "report.html").read_text())
    assert "The curve is not complete (interrupted)" in page and "points up to there are solutions" in page
    assert "not a solution" not in page


def test_the_list_of_what_was_asked_keeps_names_of_two_words(run, two_contacts):
    page = run(two_contacts).page
    assert "<dt>at rest</dt><dd>2 of 2 contacts" in page
    assert "<dt></dt>" not in page


def test_rounding_is_not_printed_as_a_multiplier(run, scenes):
    assert "a modulus below 10⁻¹²" in sentences(run(scenes / "jones_legrand_2014" / "case1.toml").page)


def test_coexisting_motions_are_drawn_and_listed(run, scenes):
    record = run(scenes / "impacts" / "oscillator.toml", "--analysis", "motions",
                 set=("analysis.random_starts=3",))
    assert "motion 1" in svg_text(record.folder / "response.svg")
    assert "<h3>Motions at this frequency</h3>\n<" in record.page
    assert "short of the gap" not in record.page  # an impact is at the gap, between two samples


def test_contacts_of_many_rows_have_short_names(command, matrix, tmp_path, two_contacts):
    many = two_contacts.replace("dofs = [2]\n", "dofs = [2, 4, 1, 3]\ncoefficients = [0.25, 0.25, 0.25, 0.25]\n", 1)
    many = many.replace("tangent = [1]", "", 1).replace("normal_stiffness = 50.0\n", "")
    many = many[:many.index("[[contact.pairs]]\ndofs = [4]")] + many[many.index("[forcing]"):]
    (tmp_path / "many.toml").write_text(many.replace("dofs = [2, 4, 1, 3]", "dofs = [1, 2, 3, 4]"))
    text = command("check", "many.toml").text
    assert "row 1, row 2, row 3, row 4" in text, text


def test_friction_that_opens_is_not_said_to_act_everywhere(command, tmp_path, two_contacts):
    (tmp_path / "scene.toml").write_text(two_contacts)
    text = command("check", "scene.toml").text
    assert "coulomb law at 2 contacts, open where the normal force is 0" in text, text


def test_contacts_are_shown_by_the_names_that_a_scene_gives_them(command, run, tmp_path, two_contacts):
    named = two_contacts.replace("dofs = [4]\n", 'name = "baffle"\ndofs = [4]\n')
    (tmp_path / "named.toml").write_text(named)
    text = command("check", "named.toml").text
    assert "at baffle" in text and "row 4" not in text, text
    record = run(named)
    assert record.code == 0, record.errors
    assert 'name = "baffle"' in (record.folder / "scene.toml").read_text()
    assert record.summary["leading_contact"] == 1 or "baffle" in record.page


TURNING = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
dof_map = "turning.dof"
modal_damping = 0.05
contact_dofs = [1]
[contact]
law = "linear"
stiffness = 1e3
gap = 1e-3
[forcing]
load_dofs = [1]
amplitude = 5.0
frequency = 5.0
[time]
trial = "fourier"
weight = "fourier"
functions = 31
[analysis]
{analysis}
"""


@pytest.mark.parametrize("analysis", ['type = "forced_response"',
                                      'type = "frequency_sweep"\nfrequency_from = 4.0\nfrequency_to = 9.0'])
def test_rotations_are_told_and_drawn_in_radians(run, matrix, tmp_path, analysis):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1e3]])
    (tmp_path / "turning.dof").write_text("4.5\n")
    record = run(TURNING.format(analysis=analysis))
    assert record.code == 0, record.errors
    assert record.summary["displacement_unit"] == "rad"
    drawing = "".join(one.read_text() for one in record.folder.glob("*.svg"))
    assert "mrad)" in drawing and "mm)" not in drawing
    assert "gap of 1 mrad" in sentences(record.page)


def test_forces_between_rotations_are_moments(run, command, matrix, tmp_path):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1e3]])
    (tmp_path / "turning.dof").write_text("4.5\n")
    record = run(TURNING.format(analysis='type = "forced_response"'))
    assert re.search(r"largest contact force is [0-9.]+ N m\.", sentences(record.page))
    (tmp_path / "turning.toml").write_text(TURNING.format(analysis='type = "forced_response"'))
    checked = command("check", "turning.toml")
    assert "between rotations: forces in N m, stiffnesses in N m/rad" in checked.text


def test_a_unit_tells_that_a_row_without_a_name_rotates(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1e3]])
    unnamed = TURNING.replace('dof_map = "turning.dof"\n', "")
    record = run(unnamed.format(analysis='type = "forced_response"\noutputs = ["row 1 in mrad"]'))
    assert record.code == 0, record.errors
    outputs = record.summary["outputs"]
    assert outputs[0]["unit"] == "mrad" if isinstance(outputs, list) else outputs["unit"] == ["mrad"]
    assert "(mrad)" in (record.folder / "outputs.svg").read_text()


def test_the_unit_of_a_pair_tells_that_its_rows_rotate(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1e3]])
    unnamed = TURNING.replace('dof_map = "turning.dof"\n', "").replace("contact_dofs = [1]\n", "")
    pair = unnamed.replace("[forcing]", '[[contact.pairs]]\ndofs = [1]\nunit = "rad"\n[forcing]')
    record = run(pair.format(analysis='type = "forced_response"'))
    assert record.summary["displacement_unit"] == "rad", record.errors
    drawing = (record.folder / "response.svg").read_text()
    assert "mrad)" in drawing and "mm)" not in drawing
    assert re.search(r"largest contact force is [0-9.]+ N m\.", sentences(record.page))
    metres = run(pair.replace('"rad"', '"mm"').format(analysis='type = "forced_response"'))
    assert metres.code == 2 and "contact.pairs[1].unit" in metres.errors and "rad" in metres.errors


def test_a_length_of_a_rotation_is_refused(command, matrix, tmp_path):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1e3]])
    (tmp_path / "turning.dof").write_text("4.5\n")
    (tmp_path / "turning.toml").write_text(TURNING.format(analysis='type = "forced_response"\noutputs = ["node 4 ry in mm"]'))
    refused = command("check", "turning.toml")
    assert refused.code == 2 and "there is no displacement in mm; expected rad, mrad, deg" in refused.errors
