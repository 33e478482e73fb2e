"""Files of the program blade: the Campbell diagram, and the forced response on a coarser scene."""

import numpy as np
import pytest
from paper_results import SCENES, Results, run_program

#: Half the functions and points and three times the step; the histories are shown at one of its frequencies.
COARSER = {"functions = 64": "functions = 32", "quadrature_points = 128": "quadrature_points = 64",
           "largest_step = 10.0": "largest_step = 30.0", "frequency = 600.0": "frequency = 590.0"}


@pytest.fixture(scope="module")
def forced_response(tmp_path_factory):
    """The files of the forced response on the coarser scene."""
    scenes, folder = tmp_path_factory.mktemp("scenes"), tmp_path_factory.mktemp("coarser")
    text = (SCENES / "blade" / "forced_response.toml").read_text()
    for old, new in COARSER.items():
        assert old in text
        text = text.replace(old, new, 1)
    (scenes / "forced_response.toml").write_text(text)
    ended = run_program("blade", "blade", "forced_response", "--scenes", scenes, "--output", folder)
    assert ended.returncode == 0, ended.stderr
    return Results(folder)


def test_the_campbell_diagram_stiffens_with_speed_and_with_energy(results):
    table = results.table("campbell.csv")
    linear = table.numbers("linear_Hz")
    assert np.all(np.diff(linear) > 0.0)
    for row in zip(*(table.numbers(name) for name in table.columns[2:])):
        assert np.all(np.diff([frequency for frequency in row if np.isfinite(frequency)]) > 0.0)
    assert linear[0] == pytest.approx(570.0, abs=0.5)
    assert np.array_equal(table.numbers("energy_1"), linear)  # energy 1 is the linear mode at grazing
    assert table.numbers("energy_7")[0] / 570.0 == pytest.approx(1.1931, abs=0.003)


def test_the_forced_response_is_bent_by_contact_in_every_pair(forced_response):
    table = forced_response.table("forced_response.csv")
    free = forced_response.table("forced_response_without_contact.csv")
    highest = np.argmax(free.numbers("max_displacement_m"))
    for pair in table.columns[1:4]:
        peak = np.nanargmax(table.numbers(pair))
        assert table.numbers("frequency_Hz")[peak] > free.numbers("frequency_Hz")[highest]
        assert table.numbers(pair)[peak] < free.numbers("max_displacement_m")[highest]
    assert table.columns == ["frequency_Hz", "fourier_fourier", "daubechies6_daubechies6", "haar_fourier",
                             "fourier_fourier_downwards"]
    assert len(forced_response.table("forced_response_histories.csv")) == 64
    assert forced_response.has("forced_response.png")


# The curve can be drawn again with its folds at its turns and its stable parts.
def test_folds_of_the_forced_response_lie_beside_the_turns_of_its_curve(forced_response):
    curve = forced_response.table("forced_response_curve.csv")
    frequency, step = curve.numbers("frequency_Hz"), np.diff(curve.numbers("frequency_Hz"))
    turns = frequency[1:-1][step[:-1] * step[1:] < 0.0]
    folds = forced_response.table("forced_response_special_points.csv").numbers("frequency_Hz")
    assert len(folds) >= 2
    for fold in folds:
        assert np.abs(turns - fold).min() < 3.0, fold
    assert np.any(curve.numbers("unstable") == 0.0)
