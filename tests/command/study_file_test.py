"""Runs of a study's file, and errors in it."""

import pytest
import wavebalance as wb
from command_scenes import BAR
from wavebalance import _core

GAP = '[[parameters]]\nkey = "contact.gap"\n'
FREQUENCY = '[[parameters]]\nkey = "forcing.frequency"\n'
DECADES = "from = 1e-4\nto = 1e-2\nspacing = \"logarithmic\"\n"


def runs_of(text):
    """The overrides of each run of the study of the bar."""
    plan = _core.StudyPlan(text, "study.toml", BAR)
    return [plan.overrides(run) for run in range(len(plan))]


def points_of(sampling, keys):
    """The samples of keys that go from 0 to 1, a list for each key."""
    names = ("contact.gap", "forcing.amplitude", "forcing.frequency", "contact.constant", "contact.exponent")[:keys]
    runs = runs_of(sampling + "".join(f'[[parameters]]\nkey = "{name}"\nfrom = 0\nto = 1\n' for name in names))
    return [[float(run[j].split("=")[1]) for run in runs] for j in range(keys)]


@pytest.mark.parametrize("text, expected", [
    (GAP + DECADES + "count = 3\n" + '[[parameters]]\nkey = "time.functions"\nvalues = [15, 31]\n',
     [[f"contact.gap={gap}", f"time.functions={functions}"]
      for gap in ("1e-4", "0.001", "0.01") for functions in (15, 31)]),
    ('sampling = "list"\n[[parameters]]\nkey = "time.trial"\nvalues = ["fourier", "bspline"]\n'
     + FREQUENCY + "values = [120, 150.5]\n",
     [['time.trial="fourier"', "forcing.frequency=120"], ['time.trial="bspline"', "forcing.frequency=150.5"]]),
    ('[[parameters]]\nkey = "time.functions"\nfrom = 15\nto = 30\ncount = 4\n',
     [["time.functions=15"], ["time.functions=20"], ["time.functions=25"], ["time.functions=30"]]),
], ids=["a grid has every combination and its last parameter varies fastest", "a list takes all values together",
        "whole numbers are rounded"])
def test_runs_take_the_values_of_their_parameters(text, expected):
    assert runs_of(text) == expected


def test_a_latin_hypercube_has_one_run_in_each_stratum_and_depends_on_its_seed_alone():
    size = 50
    seventh = 'sampling = "latin_hypercube"\nsamples = 50\nseed = 7\n'
    points = points_of(seventh, 3)
    for column in points:
        assert sorted(int(point * size) for point in column) == list(range(size))
    assert points_of(seventh, 3) == points
    assert points_of(seventh.replace("7", "8"), 3) != points


def test_sobol_points_fill_dyadic_intervals_evenly():
    # An interval of length 1/8 holds 8 of the 63 points, the first one 7, as 0 is left out.
    for column in points_of('sampling = "sobol"\nsamples = 63\n', 5):
        counts = [sum(int(8 * point) == part for point in column) for part in range(8)]
        assert counts == [7] + 7 * [8]


@pytest.mark.parametrize("sampling", ["sobol", "latin_hypercube"])
def test_samples_stay_in_their_intervals_and_take_all_values(sampling):
    runs = runs_of(f'sampling = "{sampling}"\nsamples = 64\n' + GAP + DECADES
                   + '[[parameters]]\nkey = "time.trial"\nvalues = ["fourier", "bspline"]\n')
    gaps = [float(run[0].removeprefix("contact.gap=")) for run in runs]
    assert len(gaps) == 64
    assert 1e-4 <= min(gaps) and max(gaps) <= 1e-2
    assert abs(sum(gap < 1e-3 for gap in gaps) - 32) <= 1  # half of the ratios
    assert abs(sum(run[1] == 'time.trial="fourier"' for run in runs) - 32) <= 1


@pytest.mark.parametrize("text, message", [
    ("", "study.toml:1: parameters: expected tables [[parameters]]"),
    ('sampling = "gird"\n', 'study.toml:1: sampling = "gird": expected one of "grid", "list"'),
    ('[[parameters]]\nkey = "contact.gab"\nvalues = [1]\n',
     'study.toml:2: parameters[1].key = "contact.gab": no key of a scene; did you mean contact.gap?'),
    (GAP, "study.toml:1: parameters[1].from: missing"),
    (GAP + "from = 1\nto = 2\n", "parameters[1].count: missing"),
    (GAP + 'from = 0\nto = 2\ncount = 3\nspacing = "logarithmic"\n', "expected from and to of one sign"),
    (GAP + "value = [1]\nvalues = [1]\n",
     "study.toml:3: parameters[1].value = [ 1 ]: unknown key; did you mean values?"),
    (GAP + "values = []\n", "expected a list of values of contact.gap"),
    ('sampling = "sobol"\n' + GAP + "from = 1\nto = 2\n", "samples: missing"),
    ("samples = 3\n" + GAP + "values = [1]\n", "samples = 3: has no meaning"),
    ('sampling = "list"\n' + GAP + "values = [1]\n" + FREQUENCY + "values = [1, 2]\n",
     "1 values of contact.gap and 2 of forcing.frequency"),
    (GAP + "values = [1]\n" + GAP + "values = [1]\n", "contact.gap is there twice"),
    (GAP + "from = 1\nto = 2\ncount = 1000\n" + FREQUENCY + "from = 1\nto = 2\ncount = 1001\n",
     "expected at most 1000000 runs"),
    ("a = [[parameters\n", "study.toml:1: not valid TOML"),
])
def test_wrong_keys_and_values_name_line_key_and_what_is_allowed(text, message):
    with pytest.raises(wb.SceneError) as refused:
        runs_of(text)
    assert message in str(refused.value)


def test_a_value_that_no_scene_may_hold_is_refused_before_anything_is_solved():
    plan = _core.StudyPlan('[[parameters]]\nkey = "time.functions"\nvalues = [15, -1]\n', "study.toml", BAR)
    with pytest.raises(wb.SceneError, match="time.functions = -1"):
        plan.check()


def test_a_study_names_its_scene_relative_to_itself(command, bar, tmp_path):
    (tmp_path / "below").mkdir()
    for name in ("case", "none"):
        (tmp_path / "below" / f"{name}_study.toml").write_text(f'scene = "{name}.toml"\n{GAP}values = [1e-3]\n')
    bar.rename(tmp_path / "below" / "case.toml")
    found = command("study", "below/case_study.toml", "--output", "out", "--no-report")
    assert found.code == 0, found.errors
    assert (tmp_path / "out" / "scene.toml").read_text() == BAR
    missing = command("study", "below/none_study.toml", "--output", "other")
    assert missing.code == 2
    assert "none.toml: cannot be read" in missing.errors


def test_a_scene_in_the_place_of_a_study_is_named_as_one(command, bar):
    refused = command("study", bar, "--output", "out")
    assert refused.code == 2
    assert "this is a scene, and a study names one" in refused.errors
