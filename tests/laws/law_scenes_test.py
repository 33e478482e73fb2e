"""Scenes of every contact law: read, written, refused and solved."""

import math
from pathlib import Path

import numpy as np
import pytest

import wavebalance as wb

TABLE = "-2e-3,-4e5\n0,0\n3e-3,9e5\n"
LAWS = [  # [contact], a displacement, a velocity and the force there
    ("law = 'bilinear'\nslopes = [1e7, -2e6]\ngap = 1e-3\n", 2e-3, 0.0, 8e3),
    ("law = 'cubic'\ncubic_stiffness = -1e12\n", 1e-3, 0.0, -1e3),
    ("law = 'polynomial'\npolynomial = [1e6, 0, 1e12]\n", -1e-3, 0.0, -2e3),
    ("law = 'clearance'\nstiffness = 1e8\ngap = 1e-3\n", -1.5e-3, 0.0, -5e4),
    ("law = 'clearance'\nstiffness = 1e8\ngap = 1e-3\ngap_below = 5e-4\nstiffness_below = 2e8\n", -1.5e-3, 0.0, -2e5),
    ("law = 'table'\ntable = 'spring.csv'\n", 3e-3, 0.0, 9e5),
    ("law = 'hunt_crossley'\nhertz_stiffness = 1e9\npower = 2\ndissipation = 0.5\ngap = 1e-3\n", 2e-3, 1.0, 1.5e3),
    ("law = 'kelvin_voigt'\nstiffness = 1e8\ndamping = 1e4\ngap = 1e-3\n", 2e-3, -2.0, 8e4),
]
DAMPED = ("hunt_crossley", "kelvin_voigt")
NAMES = ["bilinear", "cubic", "polynomial", "clearance", "two clearances", "table", *DAMPED]


@pytest.fixture
def scene_with(bar_text, tmp_path):
    """The bar with another [contact]."""
    (tmp_path / "spring.csv").write_text(TABLE)
    begin, end = bar_text.index("law = "), bar_text.index("[forcing]")
    return lambda contact: bar_text[:begin] + contact + bar_text[end:]


def law_of(contact):
    """The law of the keys of a scene, of the class that has its name."""
    keys = dict(contact)
    name = "".join(word.capitalize() for word in keys.pop("law").split("_"))
    if name == "Clearance":
        return wb.Clearance(**keys)
    if name == "Bilinear":
        return wb.Bilinear(*keys["slopes"], keys["gap"])
    if name == "HuntCrossley":
        keys["stiffness"] = keys.pop("hertz_stiffness")
    if name == "KelvinVoigt":
        keys["depth"] = keys.pop("damping_depth", 0.0)
    return getattr(wb, name)(*keys.values()) if len(keys) == 1 else getattr(wb, name)(**keys)


@pytest.mark.parametrize("contact, u, v, force", LAWS, ids=NAMES)
def test_the_force_of_a_scene_is_that_of_its_formula_and_a_damper_says_what_it_dissipates(
        completed, solved, changed, scene_with, contact, u, v, force):
    text = changed(scene_with(contact), ("functions = 64", "functions = 31"))
    keys = {key: value for key, value in completed(text)["contact"].items() if key not in ("form", "mass")}
    law = law_of(keys)
    assert law.force(u, v) == pytest.approx(force, rel=1e-9)
    record = solved(text)
    assert record.converged, record.status
    motion = [record.response[name] for name in ("displacement_m", "velocity_m_per_s", "contact_force_N")]
    expected = np.array([law.force(at, speed) for at, speed in zip(*motion[:2])])
    np.testing.assert_allclose(motion[2], expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())
    assert ("contact_dissipation_J" in record.summary) == (keys["law"] in DAMPED)
    assert record.summary.get("contact_dissipation_J", 1.0) > 0.0


@pytest.mark.parametrize("contact", [one[0] for one in LAWS], ids=NAMES)
def test_a_law_is_written_and_read_back_equal(scene_file, scene_with, written_equal, tmp_path, contact):
    scene_file(scene_with(contact))
    written_equal(tmp_path / "case.toml")


@pytest.mark.parametrize("contact, key, allowed", [
    ("law = 'bilinear'\nslopes = [1e7]\ngap = 1e-3\n", "slopes", "a list of 2 numbers in N/m"),
    ("law = 'bilinear'\ngap = 1e-3\n", "slopes", "missing"),
    ("law = 'cubic'\ncubic_stiffness = 0.0\n", "cubic_stiffness", "finite and not zero"),
    ("law = 'cubic'\ncubic_stiffness = 1.0\ngap = 1e-3\n", "gap", "only with contact.law"),
    ("law = 'polynomial'\npolynomial = [0.0]\n", "polynomial", "not zero"),
    ("law = 'clearance'\nstiffness = 1e8\ngap = -1e-3\n", "gap", "at least 0"),
    ("law = 'clearance'\nstiffness = 1e8\ngap = 1e-3\ngap_below = -1.0\n", "gap_below", ">= 0"),
    ("law = 'table'\ntable = 'none.csv'\n", "table", "cannot be read"),
    ("law = 'table'\ntable = 'soft.csv'\n", "table", 'soft.csv:2: "1e-3,soft"'),
    ("law = 'hunt_crossley'\nhertz_stiffness = 1e9\npower = 0.5\ndissipation = 0.5\ngap = 1e-3\n", "power", "in 1..10"),
    ("law = 'hunt_crossley'\nhertz_stiffness = 1e9\ndissipation = 0.5\ngap = 1e-3\nform = 'force'\n", "form",
     "depends on the velocity"),
    ("law = 'kelvin_voigt'\nstiffness = 1e8\ngap = 1e-3\n", "damping", "missing"),
    ("law = 'linear'\nstiffness = 1e8\ngap = 1e-3\ndamping = 1.0\n", "damping",
     'only with contact.law = "kelvin_voigt"'),
])
def test_a_law_that_is_wrong_is_refused_with_its_key_and_what_is_allowed(
        refusal, scene_with, tmp_path, contact, key, allowed):
    (tmp_path / "soft.csv").write_text("0,0\n1e-3,soft\n")
    error = refusal(scene_with(contact))
    assert error.key == f"contact.{key}" and allowed in error.allowed


def test_a_key_of_another_law_is_refused_with_the_keys_of_this_one(refusal, scene_with):
    error = refusal(scene_with('law = "linear"\nstiffness = 1e8\ngap = 1e-3\nexponent = 50.0\n'))
    assert error.key == "contact.exponent"
    assert error.allowed == (
        'does not belong to a scene with contact.law = "linear"; only with contact.law = "exponential"; the '
        "keys of this law are stiffness, gap")


def test_the_document_of_laws_has_the_table_of_the_catalogue(scenes):
    lines = ["| `law` | force, opposed to u | keys |", "| --- | --- | --- |"]
    for law in wb._core.law_catalogue():
        keys = [f"`{one['name']}`" for one in law["parameters"] if one["name"] != "tangents"]  # defined by directions
        lines.append(f"| `\"{law['name']}\"` | {law['force']} | {', '.join(keys) or 'none'} |")
    assert len(lines) > 12
    document = scenes.parents[1] / "app" / "LAWS.md"
    assert "\n".join(lines) + "\n" in document.read_text()


def test_a_parameter_is_set_by_the_name_of_the_catalogue_and_stays_unset_otherwise(completed, scene_with):
    clearance = scene_with("law = 'clearance'\nstiffness = 1e8\ngap = 1e-3\n")
    assert completed(clearance, ["contact.gap_below=0"])["contact"]["gap_below"] == 0.0
    assert "gap_below = 0.0" in wb.complete(clearance, ["contact.gap_below=0"])
    assert "gap_below" not in completed(clearance)["contact"]


def test_a_damper_is_refused_for_haar_functions(refusal, changed, scene_with):
    error = refusal(changed(scene_with(LAWS[6][0]), ('trial = "fourier"', 'trial = "haar"')))
    assert error.key == "time.trial"
    assert '"hunt_crossley"' in error.allowed and '"haar"' in error.allowed


@pytest.fixture
def example(scenes):
    """The record of one of the scenes of laws."""
    return lambda name, *overrides: wb.run(Path(scenes) / "laws" / name, overrides)


def test_duffings_oscillator_has_its_peak_on_its_backbone_and_no_gap_to_draw(example):
    record = example("duffing.toml")
    assert record.converged, record.status
    # Where the backbone w^2 = 1 + 3/4 k3 a^2 meets c w a = F.
    w = math.sqrt(0.5 + math.sqrt(0.25 + 0.75 * 0.5 * 0.01 / (0.04 * 0.04)))
    assert record.summary["max_displacement_m"] == pytest.approx(0.1 / (0.04 * w), rel=0.02)
    assert record.summary["special_points"]["type"] == ["fold", "fold"]
    assert gap_lines(record.svg()) == 0


def gap_lines(picture):
    """Dotted lines across a picture: the gaps."""
    return picture.count("stroke-dasharray='1.2,2.4'")


def test_backlash_touches_both_sides(example):
    record = example("backlash.toml")
    assert record.converged, record.status
    assert record.summary["max_displacement_m"] > 0.5 and record.summary["min_displacement_m"] < -0.8
    assert len(record.summary["turning_points_Hz"]) == 2
    assert gap_lines(record.svg()) == 1


def test_backlash_is_a_stop_in_either_direction(example, scenes, monkeypatch):
    monkeypatch.chdir(Path(scenes) / "laws")
    text = Path("backlash.toml").read_text().replace("contact_dofs = [1]", "").replace('law = "clearance"', 'law = "linear"')
    text = text[:text.index("stiffness_below")] + """
[[contact.pairs]]
dofs = [1]
[[contact.pairs]]
dofs = [1]
side = "negative"
stiffness = 10.0
gap = 0.8
""" + text[text.index("[forcing]"):]
    one, two = (record.summary for record in (example("backlash.toml"), wb.run(text)))
    assert two["contacts"] == 2
    assert two["max_displacement_m"] == pytest.approx(one["max_displacement_m"], rel=2e-3)
    assert two["special_points"]["type"] == one["special_points"]["type"]
    for found, expected in (tuple(summary["unstable_parts"][key] for summary in (two, one)) for key in ("begin_Hz", "end_Hz")):
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-5)
    np.testing.assert_allclose(two["special_points"]["frequency_Hz"], one["special_points"]["frequency_Hz"], rtol=0.0, atol=1e-5)


def test_backlash_has_a_fold_at_its_peak_also_where_its_samples_turn_the_curve(example):
    # The kinks of 256 samples turn the curve 60 times near its peak, at which the stability changes once.
    special = example("backlash.toml", "time.quadrature_points=256").summary["special_points"]
    types = special["type"]
    assert "branch" not in types and types.count("fold") == 2
    assert abs(special["frequency_Hz"][types.index("fold")] - 0.3667) <= 1e-4


def test_a_rubber_stop_takes_more_than_a_tenth_of_the_work(example):
    record = example("rubber_stop.toml")
    assert record.converged, record.status
    rms = record.summary["rms_displacement_m"]
    assert record.summary["contact_dissipation_J"] > 0.1 * 0.1 * (2 * 3.14159 * 0.2 * rms) ** 2 * 5.0


RIGID = (('"exponential"', '"rigid"'), ("exponent = 50.0", ""))


@pytest.fixture
def rigid(changed, bar_text):
    """The bar against a rigid obstacle with more keys."""
    return lambda more="", *changes: changed(bar_text, *RIGID, ("constant = 1e8  ", more + "# "), *changes)


@pytest.mark.parametrize("more, changes, line, key, found, allowed", [
    ('mass = "keep"', (), 11, "contact.mass", '"keep"', "a continuum of motions"),
    ("", (("elements = 25", "elements = 1"),), 7, "structure.elements", "1", "the tip's mass goes to a neighbour"),
    ('form = "displacement"', (), 11, "contact.form", '"displacement"', "no function of the displacement"),
])
def test_a_rigid_contact_with_mass_or_a_displacement_form_is_refused(
        refusal, rigid, more, changes, line, key, found, allowed):
    error = refusal(rigid(more, *changes))
    assert (error.file, error.line, error.key, error.found) == ("case.toml", line, key, found)
    assert allowed in error.allowed


def test_the_mass_of_a_rigid_contact_is_moved_and_that_of_a_spring_is_kept(solved, completed, rigid, bar_text):
    assert "contact_mass_frequency_change" in solved(rigid()).summary
    assert "contact_mass_frequency_change" not in solved(bar_text).summary
    kept = completed(rigid('mass = "keep"', ("elements = 25", "massless_tip = true\nelements = 25")))
    assert kept["contact"]["mass"] == "keep"
    assert completed(rigid('form = "force"'))["contact"]["form"] == "force"
