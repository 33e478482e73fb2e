"""Values, defaults and the place of mistakes, as a loader reads them from the text of a scene."""

import os
import re

import pytest

import wavebalance as wb

HAAR = ('"fourier"               # 18', '"haar"               # 18')
RIGID = (('"exponential"', '"rigid"'), ("constant = 1e8  ", "# "), ("exponent", "#"))
SWEEP = ('"forced_response"        # 23', '"frequency_sweep"\nfrequency_from = 1100\nfrequency_to = 1700')
ROD = """[structure]
type = "bar"                    # 2
youngs_modulus = 2.1e11         # 3
density = 7800.0                # 4
area = 9e-4                     # 5
length = 1.0                    # 6
elements = 20                   # 7
lumped_mass_fraction = 0.5      # 8
[contact]
law = "rigid"                   # 10
gap = 1e-3                      # 11
[analysis]
type = "nonlinear_mode"         # 13
points = 200                    # 14
"""


@pytest.fixture
def tolerance(bar_text):
    """The bar with a tolerance instead of pair, functions and points."""
    begin, end = bar_text.index("trial = "), bar_text.index("[analysis]")
    return lambda value: bar_text[:begin] + f"tolerance = {value}\n" + bar_text[end:]


def test_every_value_is_read_and_defaults_are_filled_in(completed, changed, bar_text):
    scene = completed(changed(bar_text, ("quadrature_points = 256", "")))
    assert scene["structure"] == {
        "type": "bar", "youngs_modulus": 70e9, "density": 2700.0, "length": 1.0, "area": 25e-4, "elements": 25,
        "lumped_mass_fraction": 0.0, "massless_tip": False, "stiffness_damping": 1e-4, "loss_factor": 0.0}
    contact, forcing, time, analysis = (scene[one] for one in ("contact", "forcing", "time", "analysis"))
    assert contact["law"] == "exponential" and contact["exponent"] == 50.0 and contact["gap"] == 1e-3
    assert forcing["frequency"] == 150.0
    assert time["trial"] == "fourier" and time["quadrature_points"] == 4 * 64
    assert time["formulation"] == "distributional" and time["inner_products"] == "quadrature"
    assert analysis["type"] == "forced_response" and analysis["output_points"] == 1024
    assert completed(bar_text)["time"]["quadrature_points"] == 256


def test_a_scene_without_a_section_of_contact_has_no_contact(completed, bar_text):
    begin, end = bar_text.index("[contact]"), bar_text.index("[forcing]")
    assert completed(bar_text[:begin] + bar_text[end:])["contact"]["law"] == "none"


@pytest.mark.parametrize("value, trial", [("1e-4", None), ('1e-4\ntrial = "haar"\nweight = "fourier"', "haar")])
def test_a_tolerance_stands_in_place_of_functions_and_points_and_maybe_beside_a_pair(
        completed, tolerance, bar_text, value, trial):
    time = completed(tolerance(value))["time"]
    assert time["tolerance"] == 1e-4 and time.get("trial") == trial
    assert "functions" not in time and "quadrature_points" not in time
    text = wb.complete(tolerance(value))
    assert wb.complete(text) == text
    assert "tolerance" not in wb.complete(bar_text)


@pytest.mark.parametrize("value, line, key, found, allowed", [
    ("1e-4\nfunctions = 64", 19, "time.functions", "64", "not beside time.tolerance"),
    ("1e-4\nquadrature_points = 64", 19, "time.quadrature_points", "64", "not beside time.tolerance"),
    ('1e-4\ntrial = "haar"', 19, "time.trial", '"haar"', "both time.trial and time.weight"),
    ('1e-4\ntrial = "haar"\nweight = "haar"', 19, "time.trial", '"haar"', "not an admissible"),
    ("2.0", 18, "time.tolerance", "2.0", "out of range"),
    ("0.0", 17, "time.trial", "", "missing"),
])
def test_a_tolerance_beside_what_it_chooses_is_refused(refusal, tolerance, value, line, key, found, allowed):
    assert_refused(refusal(tolerance(value)), line, key, found, allowed)


def test_a_tolerance_is_for_forced_responses(refusal, changed, tolerance):
    error = refusal(changed(tolerance("1e-4"), ("forced_response", "time_stepping")))
    assert_refused(error, 18, "time.tolerance", "1e-4", 'only with analysis.type = "forced_response"')


@pytest.mark.parametrize("offset, read", [(None, 0.0), ("0", 0.0), ("0.5", 0.5)])
def test_a_sample_offset_is_a_left_end_or_a_middle(completed, changed, bar_text, offset, read):
    text = bar_text if offset is None else changed(bar_text, ("[time]", f"[time]\nsample_offset = {offset}"))
    assert completed(text)["time"]["sample_offset"] == read
    assert wb.complete(wb.complete(text)) == wb.complete(text)


@pytest.mark.parametrize("overrides, part", [
    *((["time.sample_offset=" + value], "expected 0 or 0.5") for value in ("0.25", "1", "-0.5")),
    *((["time.sample_offset=0.5", "analysis.type=" + kind],
       "time.sample_offset = 0.5: does not belong to a scene with analysis.type")
      for kind in ("time_stepping", "nonlinear_mode")),
    (["time.quadrature_points=64", "time.sample_offset=0.5", "time.nyquist=keep"],
     "vanishes at the middles of 64 intervals"),
    (["contact.gab=1"], "did you mean contact.gap?"),
    ([".gap=1"], "expected section.key=value"),
    (["contact.=1"], "expected section.key=value"),
    (["contact.gap="], 'contact.gap = ""'),
    (["contact.gap=1\nother=2"], "expected a number in m"),  # no second key
])
def test_an_override_that_is_wrong_has_a_message(refusal, bar_text, overrides, part):
    assert part in str(refusal(bar_text, overrides))


def test_a_sample_offset_beside_a_tolerance_is_refused(refusal, tolerance):
    message = str(refusal(tolerance("1e-4"), ["time.sample_offset=0.5"]))
    assert "time.sample_offset = 0.5: not beside time.tolerance" in message


def test_middles_at_which_the_nyquist_coefficient_vanishes_drop_it_or_need_exact_products(completed, bar_text):
    middles = ["time.quadrature_points=64", "time.sample_offset=0.5"]
    assert completed(bar_text, middles)["time"]["nyquist"] == "drop"
    kept = completed(bar_text, [*middles, "time.nyquist=keep", "time.inner_products=exact"])
    assert kept["time"]["sample_offset"] == 0.5


@pytest.mark.parametrize("wrong, overrides, message", [
    ('gap = "big"', None, 'case.toml:13: contact.gap = "big": expected a number in m'),
    ("gap = 1e-3", ["contact.gap=big"], '--set contact.gap=big: contact.gap = "big": expected a number in m'),
    ("gap = 1e-3", ["gap"], "--set gap: expected section.key=value, as in contact.gap=2e-3"),
])
def test_a_message_holds_file_and_line_or_the_override_the_key_the_value_and_what_is_allowed(
        refusal, changed, bar_text, wrong, overrides, message):
    assert str(refusal(changed(bar_text, ("gap = 1e-3", wrong)), overrides)) == message


def assert_refused(error, line, key, found, allowed):
    assert (error.file, error.line, error.key, error.found) == ("case.toml", line, key, found), str(error)
    assert allowed in error.allowed


WRONG = [  # an old text, a new one, and of the error its line, key, value and a part of what is allowed
    # types
    ("area = 25e-4", "area = true", 5, "structure.area", "true", "a number in m^2, > 0"),
    ("elements = 25", "elements = 25.0", 7, "structure.elements", "25.0", "an integer"),
    ('law = "exponential"', "law = 3", 10, "contact.law", "3", '"exponential"'),
    ("length = 1.0", "length = [1.0]", 6, "structure.length", "[ 1.0 ]", "a number in m"),
    ("length = 1.0", "length = 2020-01-01", 6, "structure.length", "2020-01-01", "a number"),
    # numbers out of range or not finite
    ("density = 2700", "density = -1", 4, "structure.density", "-1", "> 0"),
    ("density = 2700", "density = 0.0", 4, "structure.density", "0.0", "> 0"),
    ("elements = 25", "elements = 0", 7, "structure.elements", "0", "in 1.."),
    ("functions = 64", "functions = 99999999999", 20, "time.functions", "99999999999", "in 1.."),
    ("functions = 64", "functions = -1", 20, "time.functions", "-1", "in 1.."),
    ("stiffness_damping = 1e-4", "lumped_mass_fraction = 1.5", 8, "structure.lumped_mass_fraction", "1.5", "in 0..1"),
    ("gap = 1e-3", "gap = nan", 13, "contact.gap", "nan", "finite"),
    ("amplitude = 250e3", "amplitude = -inf", 15, "forcing.amplitude", "-inf", "finite"),
    # unknown keys and choices
    ("gap = 1e-3", "gpa = 1e-3", 13, "contact.gpa", "0.001", "did you mean contact.gap?"),
    ("youngs_modulus", "young_modulus", 3, "structure.young_modulus", "7e10", "did you mean structure.youngs_modulus?"),
    ("gap = 1e-3", "wall_thickness = 1", 13, "contact.wall_thickness", "1",
     "known are law, constant, exponent, stiffness, "),
    ("[forcing]", "[forcings]", 14, "[forcings]", "", "did you mean [forcing]?"),
    ("[structure]", "gap = 1\n[structure]", 1, "gap", "1", "outside of any section"),
    ("# 23\n", "# 23\n[extra]\n", 24, "[extra]", "", "unknown section"),
    ('trial = "fourier"', 'trial = "fourrier"', 18, "time.trial", '"fourrier"', 'did you mean "fourier"?'),
    ('trial = "fourier"', 'trial = "daubechies7"', 18, "time.trial", '"daubechies7"',
     '"daubechiesN" with an even N in 2..40'),
    # missing keys
    ("amplitude = 250e3", "", 14, "forcing.amplitude", "", "missing; expected a number in N"),
    ("exponent = 50.0", "", 9, "contact.exponent", "", "missing"),
    ("frequency = 150.0", "", 14, "forcing.frequency", "", "missing"),
    ("functions = 64", "", 17, "time.functions", "", "missing"),
    # keys of another law or analysis
    ("exponent = 50.0", "exponent = 50.0\nstiffness = 1e8", 13, "contact.stiffness", "1e8",
     'only with contact.law = "linear"'),
    ('law = "exponential"', 'law = "none"', 11, "contact.constant", "1e8", 'only with contact.law = "exponential"'),
    ("# 23\n", "# 23\nmax_periods = 10\n", 24, "analysis.max_periods", "10",
     'only with analysis.type = "time_stepping"'),
    ('"exponential"', '"rigid"', 11, "contact.constant", "1e8", 'contact.law = "exponential"'),
    # points of quadrature
    ("quadrature_points = 256", "quadrature_points = 63", 21, "time.quadrature_points", "63", "functions = 64"),
]
HAAR_WRONG = [
    ("functions = 64", "functions = 48", 20, "time.functions", "48", "power of two"),
    ("quadrature_points = 256", "quadrature_points = 100", 21, "time.quadrature_points", "100", "power of two"),
    ("# 23\n", "# 23\noutput_points = 1000\n", 24, "analysis.output_points", "1000", "power of two"),
    ('weight = "fourier"', 'weight = "haar"', 18, "time.trial", '"haar"', "not an admissible trial basis"),
    ('weight = "fourier"', 'weight = "daubechies6"', 18, "time.trial", '"haar"', "not an admissible trial basis"),
]
SWEEP_WRONG = [
    ("_to = 1700", "_to = 1100", 25, "analysis.frequency_to", "1100", "another frequency"),
    ("frequency_to = 1700", "", 22, "analysis.frequency_to", "", "missing"),
    ("_to = 1700\n", "_to = 1700\nfirst_step = 8\n", 26, "analysis.first_step", "8", "largest_step = 7.5"),
]


@pytest.mark.parametrize("before, wrong", [
    *(((), one) for one in WRONG), *(((HAAR,), one) for one in HAAR_WRONG), *(((SWEEP,), one) for one in SWEEP_WRONG)])
def test_a_wrong_value_is_an_error_at_its_line(refusal, changed, bar_text, before, wrong):
    assert_refused(refusal(changed(bar_text, *before, wrong[:2])), *wrong[2:])


@pytest.mark.parametrize("text, line, key, found, allowed", [
    ("contact = 1\n", 1, "contact", "1", "a section [contact]"),
    ("", 0, "structure.type", "", "in a section [structure]"),
])
def test_a_text_without_sections_is_refused(refusal, text, line, key, found, allowed):
    assert_refused(refusal(text), line, key, found, allowed)


@pytest.mark.parametrize("changes", [
    (HAAR,),
    (("functions = 64", "functions = 63"), ("= 256", "= 100")),
    (HAAR, ('weight = "fourier"', 'weight = "bspline"')),
])
def test_admissible_pairs_and_sizes_are_read(completed, changed, bar_text, changes):
    assert completed(changed(bar_text, *changes))["time"]["functions"] in (63, 64)


def test_the_steps_of_a_sweep_come_from_its_interval(completed, changed, bar_text):
    analysis = completed(changed(bar_text, SWEEP))["analysis"]
    assert analysis["first_step"] == 0.6 and analysis["largest_step"] == 7.5


def test_time_stepping_needs_no_bases_and_few_elements(completed, refusal, changed, bar_text):
    text = bar_text[:bar_text.index("[time]")] + '[analysis]\ntype = "time_stepping"\n'
    assert completed(text)["analysis"]["tolerance"] == 1e-7
    many = refusal(changed(text, ("elements = 25", "elements = 5000")))
    assert_refused(many, 7, "structure.elements", "5000", "at most 2000")


def test_a_nonlinear_mode_needs_neither_forcing_nor_bases(completed):
    analysis = completed(ROD)["analysis"]
    assert analysis["type"] == "nonlinear_mode" and analysis["samples"] == 20
    assert analysis["cosine_only"] is False and analysis["energy_ratio"] == 0.0
    text = wb.complete(ROD)
    assert wb.complete(text) == text


@pytest.mark.parametrize("changes, line, key, found, allowed", [
    ([('law = "rigid"                   # 10', 'law = "none"'), ("gap = 1e-3", "#")], 10, "contact.law", '"none"',
     '"exponential"'),
    ([("gap = 1e-3", "gap = 0.0")], 11, "contact.gap", "0.0", "> 0"),
    ([("# 8", "\nstiffness_damping = 1e-6")], 9, "structure.stiffness_damping", "1e-6", "expected 0"),
    ([("points = 200 ", "mode = 21 ")], 14, "analysis.mode", "21", "at most"),
    ([("points = 200 ", "samples = 19 ")], 14, "analysis.samples", "19", "= 20"),
    ([("points = 200 ", "cosine_only = 1 ")], 14, "analysis.cosine_only", "1", "true or false"),
    ([("points = 200 ", "tolerance = 1e-3 ")], 14, "analysis.tolerance", "0.001", "time_stepping"),
])
def test_a_nonlinear_mode_has_contact_and_no_damping(refusal, changed, changes, line, key, found, allowed):
    assert_refused(refusal(changed(ROD, *changes)), line, key, found, allowed)


def test_a_rigid_contact_takes_a_gap_alone(completed, refusal, changed, bar_text):
    rigid = changed(bar_text, *RIGID)
    assert completed(rigid)["contact"] == {"law": "rigid", "gap": 1e-3, "form": "automatic", "mass": "automatic"}
    assert wb.complete(wb.complete(rigid)) == wb.complete(rigid)
    stepping = refusal(rigid, ["analysis.type=time_stepping"])
    assert stepping.key == "contact.law" and "law of impact" in stepping.allowed
    one = ["structure.massless_tip=true", "structure.elements=1"]
    assert refusal(rigid, one).key == "structure.elements"
    stepped = ["structure.massless_tip=true", "analysis.type=time_stepping"]
    assert refusal(bar_text, stepped).key == "structure.massless_tip"


def test_an_error_of_syntax_carries_its_line(refusal, changed, bar_text):
    error = refusal(changed(bar_text, ("gap = 1e-3", "gap = ")))
    assert error.line == 13 and "not valid TOML" in error.allowed
    assert "case.toml:2" in str(refusal("a = 1\na = 2\n"))


def test_overrides_are_applied_before_checks(completed, changed, bar_text):
    scene = completed(bar_text, ["contact.gap=2e-3", "time.trial=haar", 'time.weight="fourier"', "time.functions=32",
                                 "contact.gap=3e-3"])
    assert scene["contact"]["gap"] == 3e-3
    assert scene["time"]["trial"] == "haar" and scene["time"]["functions"] == 32
    assert completed(changed(bar_text, ("gap = 1e-3", 'gap = "big"')), ["contact.gap=1"])["contact"]["gap"] == 1.0
    assert completed(bar_text, [" contact.gap = 2e-3 "])["contact"]["gap"] == 2e-3  # blanks around


def test_files_that_cannot_be_read_are_errors(tmp_path):
    with pytest.raises(wb.SceneError, match="missing.toml: cannot be read: No such file"):
        wb.complete(tmp_path / "missing.toml")
    with pytest.raises(wb.SceneError):
        wb.complete(tmp_path)


def test_a_file_whose_name_holds_spaces_and_quotes_is_read(tmp_path, bar_text):
    file = tmp_path / "a 'scene'\".toml"
    file.write_text(bar_text)
    assert wb.complete(file) == wb.complete(bar_text)


def test_devices_pipes_and_large_files_are_refused_by_name(command, tmp_path):
    pipe, large = tmp_path / "pipe.toml", tmp_path / "large.toml"
    os.mkfifo(pipe)
    large.write_text("\n" * 2_000_000)
    irregular = "cannot be read: it is not a regular file\n"
    for file, message in (("/dev/zero", irregular), (pipe, irregular), (large, "more than 1048576 bytes")):
        refused = command("check", file, timeout=20)
        assert refused.code == 2 and f"{file}: " in refused.errors and message in refused.errors


@pytest.mark.parametrize("law", ["linear", '"linear', 'linear"'])
def test_a_text_without_its_quotes_is_shown_with_them(refusal, changed, bar_text, law):
    error = refusal(changed(bar_text, ('law = "exponential"', f"law = {law}")))
    assert "not valid TOML" in error.allowed
    assert '; a text stands between quotes, as in law = "linear"' in error.allowed


def test_a_number_that_is_wrong_is_no_text_without_quotes(refusal, changed, bar_text):
    assert "between quotes" not in refusal(changed(bar_text, ("gap = 1e-3", "gap = 1e-3.5"))).allowed


@pytest.mark.parametrize("parts", [8, 9, 100000, 400000])
def test_a_key_of_more_than_eight_parts_is_refused_with_its_line(command, refusal, scene_file, bar_text, parts):
    key = ".".join("a" * parts)
    expected = "a key has more than 8 parts between dots; expected section.key or [section]"
    for line in (f"{key} = 1\n", f"[{key}]\n"):
        errors = command("check", scene_file(bar_text + line)).errors
        assert (f"case.toml:24: {expected}\n" in errors) == (parts > 8)
    assert (expected in str(refusal(bar_text, ["time.trial={" + key + " = 1}"]))) == (parts > 8)


@pytest.mark.parametrize("text", [
    "'" + "." * 1000 + "'", '"\\"' + "." * 1000 + '"', '"""\n' + "." * 1000 + '\n"""',
    "[1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1.5]"])
def test_dots_in_texts_comments_and_numbers_are_no_keys(completed, refusal, changed, bar_text, text):
    assert completed(bar_text + "# " + "." * 1000 + "\n") == completed(bar_text)
    assert "case.toml:18: time.trial" in str(refusal(changed(bar_text, ('"fourier"               # 18', text))))


def test_every_key_is_described_within_the_width(command):
    described = command("keys").text
    assert all(len(line) <= 100 for line in described.splitlines())
    entries = dict.fromkeys(re.findall(r"^  (\w+)\n      \S", described, re.MULTILINE))  # a name, then its help
    names = [line.split()[0] for line in command("keys", "--names").text.splitlines()]
    assert len(names) > 100
    for name in names:
        section, key = name.split(".", 1)
        assert key in entries, name
        alone = command("keys", name).text
        assert re.search(rf"^\[{section}\]\n(  .*\n)*?  {key}\n      \S", alone, re.MULTILINE), name
    nothing = command("keys", "contact.nothing")
    assert nothing.code == 2 and "keys contact.nothing" in nothing.errors
