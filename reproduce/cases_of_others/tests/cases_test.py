"""Each case agrees with what is known of it, and leaves what the page needs."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import cases

NAMES = sorted(file.stem for file in cases.HERE.glob("*.toml"))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Where the cases of this module leave their files."""
    return tmp_path_factory.mktemp("results")


@pytest.mark.parametrize("name", NAMES)
def test_each_value_agrees_within_its_tolerance(name, results):
    folder = results / cases.FOLDER
    rows, checks = cases.compute(name, os.environ["WAVEBALANCE_COMMAND"], folder)
    assert [f"{one.quantity}: {one.difference:.2g}" for one in rows if one.given is not None and not one.agrees] == []
    assert [one["sentence"] for one in checks if not one["passes"]] == []
    record = json.loads((folder / "records" / f"{name}.json").read_text())
    assert all((folder / file).stat().st_size > 0 for file in record["files"])
    assert all((folder / "scenes" / one["name"]).exists() for one in record["scenes"])
    figure = (folder / f"{name}.figure.js").read_text()
    assert f'["{name}"] = ' in figure
    assert '{"title":"","x":' not in figure or figure.count('"legend":') == 1  # panels with a letter have a title


def test_the_page_shows_every_case(results):
    program = os.environ.get("WAVEBALANCE_REPORT_PAGE")
    if not program:
        pytest.skip("the report on the papers is not built")
    subprocess.run([program, "--results", results], check=True)
    page = (results / cases.FOLDER / "index.html").read_text()
    made = [name for name in NAMES if (results / cases.FOLDER / "records" / f"{name}.json").exists()]
    assert [name for name in made if f'id="{name}"' not in page or f'src="{name}.svg"' not in page] == []
    assert "wavebalance run reproduce/scenes/cases_of_others/" in page


def test_a_curve_of_impacts_shows_their_impulses(results):
    folder = results / cases.FOLDER
    if not (folder / "impact_oscillator.csv").exists():
        cases.compute("impact_oscillator", os.environ["WAVEBALANCE_COMMAND"], folder)
    lines = [line.split(",") for line in (folder / "impact_oscillator.csv").read_text().splitlines()]
    impulses = [float(line[lines[0].index("max_impulse_Ns")]) for line in lines[1:]]
    assert impulses[0] == 0.0 and max(impulses) > 3.0
    assert "mpulse" in (folder / "impact_oscillator.figure.js").read_text()


def test_harmonics_of_a_sum_of_cosines_are_its_amplitudes():
    from math import cos, pi, sin
    samples = [-2.0 + 3.0 * cos(2 * pi * k / 64 + 0.3) + 0.5 * sin(6 * pi * k / 64) for k in range(64)]
    assert [cases.harmonic(samples, n) for n in range(4)] == pytest.approx([2.0, 3.0, 0.0, 0.5], abs=1e-14)


def test_a_run_that_does_not_end_well_is_named(tmp_path):
    with pytest.raises(cases.NotSolved, match="slider.toml --set contact.law=none: exit code 2"):
        cases.Run(Path(os.environ["WAVEBALANCE_COMMAND"]), "slider.toml", ["--set", "contact.law=none"], tmp_path / "out")
