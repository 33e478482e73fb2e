"""Pictures of records and the curves of their pages show the content of the record, and no more."""

import re
import shutil

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import BAR, CHAIN, CHAIN_FILES, ROD, STOP, changed, curves_of, names_in

PLACES = 6  # digits of the numbers in the scripts of pages


@pytest.fixture(scope="module")
def solve(tmp_path_factory):
    """Solves a scene, given as path or text, with other values; returns its record and its folder."""

    def run(scene, overrides=None):
        folder = tmp_path_factory.mktemp("run") / "out"
        return wb.run(scene, overrides, folder), folder

    return run


@pytest.fixture(scope="module")
def response(solve):
    return solve(BAR)


@pytest.fixture(scope="module")
def sweep(solve):
    """The record of a curve with two folds, its folder and its figure."""
    record, folder = solve(STOP)
    return record, folder, figure_of(folder, "sweep")


def figure_of(folder, name):
    return curves_of((folder / f"{name}.figure.js").read_text())


def series_of(panel):
    return {one["label"]: one for one in panel["series"]}


def numbers(values):
    return np.array([np.nan if one is None else one for one in values], dtype=float)


def test_a_picture_holds_its_labels_its_legend_and_a_letter_for_each_of_several_panels(response, sweep, solve):
    three, one = response[0].svg(), solve(ROD)[0].svg()
    for text in ("<svg", "</svg>", "Time (fraction of a period)", "Displacement (mm)", "(a)", "(b)", "(c)"):
        assert text in three, text
    assert "</svg>" in one and "(a)" not in one
    assert "largest" in sweep[0].svg() and "rms including mean" in sweep[0].svg()


def test_a_picture_is_the_same_every_time(response):
    assert response[0].svg() == response[0].svg() == wb.run(BAR).svg()


def test_both_kinds_of_pictures_are_written_beside_each_other(command, response, tmp_path):
    assert command("overlay", response[1], "-o", "new folder's").code == 0
    folder = tmp_path / "new folder's"
    assert names_in(folder) >= {"overlay.svg", "overlay.png"}
    assert (folder / "overlay.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def test_names_are_shown_as_they_are_and_run_no_commands(tmp_path):
    mark = tmp_path / "mark"
    names = (f"`touch {mark}` $(touch {mark}) a_b^{{c}}", f"x' , system('touch {mark}') title ' a_b^{{c}}", "'it's' a_b^{c}")
    pairs = "".join(f'[[contact.pairs]]\ndofs = [{i + 1}]\nname = "{name}"\n' for i, name in enumerate(names))
    for name, text in CHAIN_FILES.items():
        (tmp_path / name).write_text(text)
    scene = changed(CHAIN, ("contact_dofs = [2, 3]\n", ""), ("[forcing]", pairs + "[forcing]"))
    (tmp_path / "case.toml").write_text(scene + "contact_outputs = true\n")
    wb.run(tmp_path / "case.toml", output=tmp_path / "out")
    for picture in ("outputs.svg", "response.svg"):
        shown = (tmp_path / "out" / picture).read_text()
        found = [name.replace("'", "\u2019") in shown for name in names]
        assert all(found) if picture == "outputs.svg" else any(found), picture  # only the strongest contact
    assert not mark.exists()


@pytest.mark.parametrize("name", ["`touch mark` $(touch mark)", "x' , system('touch mark') title '",
                                  "'\nsystem(\"touch mark\")\nset xlabel '"])
def test_names_of_curves_run_no_commands(command, sweep, tmp_path, name):
    shutil.copytree(sweep[1], tmp_path / name)
    drawn = command("overlay", tmp_path / name, "-o", "out")
    assert drawn.code == 0, drawn.errors
    assert {one.name for one in tmp_path.rglob("*")} & {"mark", "overlay.svg"} == {"overlay.svg"}


def test_panels_have_axes_curves_and_the_gap(response):
    panel = figure_of(response[1], "response")["panels"][0]
    assert panel["title"] == "Displacement (shaded: contact)"
    assert panel["x"]["label"] == "Time (fraction of a period)"
    assert (panel["x"]["lower"], panel["y"]["upper"]) == (-0.5, None)
    assert (panel["series"][0]["colour"], panel["series"][0]["dash"]) == ("#0072B2", "")
    (gap,) = panel["segments"]
    assert (gap["from"], gap["label"]) == ([None, 1.0], "gap")
    assert ">gap<" in response[0].svg()


@pytest.mark.parametrize("overrides, shaded", [({}, True), ({"analysis.phases": False}, False)])
def test_each_panel_shades_the_exact_solutions_of_contact(solve, overrides, shaded):
    record, folder = solve(BAR, overrides)
    phases = record.summary["phases"] if shaded else {"begin": [], "end": []}
    lengths = np.subtract(phases["end"], phases["begin"])
    panels = figure_of(folder, "response")["panels"]
    assert len(panels) == 3
    for panel in panels:
        spans = [one["x"] for one in panel["rectangles"]]
        # An interval of contact is not cut by the edges of the picture.
        assert len(spans) == len(lengths) == int(shaded)
        assert all(panel["x"]["lower"] <= begin <= end <= panel["x"]["upper"] for begin, end in spans)
        assert sum(end - begin for begin, end in spans) == pytest.approx(lengths.sum(), rel=0, abs=10.0**-PLACES)
        assert ("shaded" in panel["title"]) == shaded


def test_lines_lose_only_points_that_nobody_can_miss(solve):
    record, folder = solve(BAR, {"analysis.output_points": 16384})
    thin = figure_of(folder, "response")["panels"][0]["series"][0]
    assert len(thin["x"]) < 500
    time, whole = (np.asarray(record.response[name]) for name in ("time_fraction", "displacement_m"))
    place = (time + 0.5) % 1.0 - 0.5
    drawn = 1e-3 * np.interp(place, thin["x"], thin["y"])
    assert np.abs(drawn - whole).max() < 5e-4 * np.ptp(whole)  # of the height of the picture


@pytest.fixture(scope="module")
def light(solve):
    """The bar under a load that does not close the contact, and the lowest and highest displacement of its tip."""
    record, _ = solve(BAR, {"forcing.amplitude": 10e3, "contact.gap": 1.0})
    return record.summary["min_displacement_m"], record.summary["max_displacement_m"]


@pytest.mark.parametrize("beyond, near", [(0.4, True), (0.6, False)])
def test_a_gap_stays_on_its_axis_or_is_named_in_the_title(solve, light, beyond, near):
    gap = light[1] + beyond * (light[1] - light[0])
    record, folder = solve(BAR, {"forcing.amplitude": 10e3, "contact.gap": gap})
    panel = figure_of(folder, "response")["panels"][0]
    assert record.summary["contact_fraction"] == 0.0
    assert [one["label"] for one in panel["segments"]] == (["gap"] if near else [])
    outside = "" if near else f", gap {1e6 * gap:.4g} \u00b5m, outside of the axis"
    assert panel["title"] == "Displacement" + outside
    if near:
        assert panel["y"]["lower"] is None and panel["y"]["upper"] > 1e6 * gap


def test_unstable_parts_are_dashed_from_one_special_point_to_the_other(sweep):
    record, _, figure = sweep
    series, points = series_of(figure["panels"][0]), record.summary["special_points"]
    folds = [(x, y) for kind, x, y in zip(points["type"], points["frequency_Hz"], points["max_displacement_m"])
             if kind == "fold"]
    assert len(folds) == 2 and folds[0][0] > folds[1][0]  # on the part that turns back
    solid, dashed = series["largest"], series["largest, unstable"]
    assert (solid["dash"], dashed["dash"]) == ("", "8 5")
    x, y = numbers(solid["x"]), numbers(solid["y"])
    (gap,) = np.flatnonzero(np.isnan(y))
    ends = [(x[gap - 1], y[gap - 1]), (x[gap + 1], y[gap + 1])]
    assert np.allclose(ends, folds, rtol=10.0**(1 - PLACES), atol=0.0)
    assert np.allclose([(dashed["x"][i], dashed["y"][i]) for i in (0, -1)], folds, rtol=10.0**(1 - PLACES), atol=0.0)
    assert (np.diff(numbers(dashed["x"])) < 0).all()


def test_grazings_of_an_output_are_marked_on_its_curve(solve):
    _, folder = solve({
        "structure": {"type": "matrices", "mass": np.array([[5.0]]), "damping": np.array([[37.7]]),
                      "stiffness": np.array([[28424.0]]), "contact_dofs": [1]},
        "contact": {"law": "clearance", "stiffness": 2.5e5, "gap": 6e-3},
        "forcing": {"terms": [{"kind": "base_acceleration", "dofs": [1], "amplitude": 9.81}]},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 63},
        "analysis": {"type": "frequency_sweep", "frequency_from": 5.0, "frequency_to": 40.0, "outputs": [1]}})
    output, contact = (series_of(panel)["grazing"] for panel in figure_of(folder, "sweep")["panels"][:2])
    assert len(output["y"]) >= 2 and output["x"] == contact["x"]
    assert output["y"] == pytest.approx(contact["y"], rel=5e-3)


def test_a_missing_value_interrupts_the_line_of_a_picture(sweep, solve):
    def strokes(record):
        (first, *_) = re.findall(r"<path stroke='rgb\(  0, 114, 178\)'\s+d='([^']*)'", record.svg())
        return first.count("M")

    assert strokes(sweep[0]) == 2
    assert strokes(solve(STOP, {"analysis.stability": False})[0]) == 1


def test_without_stability_a_curve_is_solid(solve):
    _, folder = solve(STOP, {"analysis.stability": False})
    series = series_of(figure_of(folder, "sweep")["panels"][0])
    assert {one["dash"] for one in series.values()} == {""}
    assert None not in series["largest"]["y"]


def test_each_kind_of_special_point_has_one_entry_of_the_legend(sweep):
    record, _, figure = sweep
    points = record.summary["special_points"]
    entries = [one for one in figure["panels"][0]["series"] if one["style"] == "points"]
    assert sorted(one["label"] for one in entries) == sorted(set(points["type"]))
    for entry in entries:
        places = [x for kind, x in zip(points["type"], points["frequency_Hz"]) if kind == entry["label"]]
        assert entry["x"] == pytest.approx(places, rel=10.0**(1 - PLACES))
    assert {"fold", "grazing"} <= {one["label"] for one in entries}


def test_dashes_end_at_a_grazing_where_no_other_point_ends_them(solve, scenes):
    record, folder = solve(scenes / "jones_legrand_2014" / "case2_sweep.toml")
    points = record.summary["special_points"]
    assert points["type"] == ["grazing", "fold", "grazing"]
    dashed = series_of(figure_of(folder, "sweep")["panels"][0])["largest, unstable"]
    for end, point in ((0, 1), (-1, 2)):
        assert dashed["x"][end] == pytest.approx(points["frequency_Hz"][point], rel=10.0**(1 - PLACES))
        assert dashed["y"][end] == pytest.approx(1e3 * points["max_displacement_m"][point], rel=10.0**(1 - PLACES))


def test_a_curve_that_is_not_complete_says_so_as_it_is_written(solve):
    record, folder = solve(STOP, {"analysis.max_points": 5})
    assert record.status == "point_limit"
    assert "point\\_limit" in figure_of(folder, "sweep")["title"]
    assert "point_limit" in record.svg()


@pytest.mark.parametrize("scene, overrides, end", [
    ("matrices/strip_mode.toml", {}, "5 % beyond"),
    ("laxalde_legrand_2010/rod.toml", {"analysis.points": 200}, "largest_energy"),
])
def test_the_axis_of_energies_ends_with_the_curve(solve, scenes, scene, overrides, end):
    record, folder = solve(scenes / scene, overrides)
    largest = record.summary["largest_energy_ratio"]
    asked = float(re.search(r"\nlargest_energy = ([0-9.]+)", record.scene).group(1))
    axis = figure_of(folder, "backbone")["panels"][0]["x"]
    assert (1.05 * largest < asked) == (end == "5 % beyond")
    assert axis["upper"] == pytest.approx(min(1.05 * largest, asked), rel=10.0**(1 - PLACES))

