"""Scenes that tests of analyses share, each solved once, and what they read from its record."""

import functools
import html
import json
import re
import tempfile
from pathlib import Path

import numpy as np
from rods_and_bars import BAR

import wavebalance

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes"
JONES = SCENES / "jones_legrand_2014"

FOURIER = {"trial": "fourier", "weight": "fourier"}

BAR_SWEEP = {"time.functions": 31, "analysis.type": "frequency_sweep", "analysis.frequency_from": 100,
             "analysis.frequency_to": 110}
#: Damping without a known motion of the structure.
LOSS_FACTOR = {"structure.loss_factor": 0.02, "structure.stiffness_damping": 0}
SIZES = ("time.functions", "time.quadrature_points")
BALANCE_KEYS = ("time.trial", "time.weight", *SIZES)

# m = k = 1, c = 0.05, a stop of 2 N/m at 1 m, 0.2 N: a bar of one element. The curve has two folds, near 0.1737 Hz and
# 0.1892 Hz, between which there are three motions.
STOP = {
    "structure": {"type": "bar", "youngs_modulus": 1.0, "density": 2.0, "area": 1.0, "length": 1.0, "elements": 1,
                  "lumped_mass_fraction": 1.0, "stiffness_damping": 0.05},
    "contact": {"law": "linear", "stiffness": 2.0, "gap": 1.0},
    "forcing": {"amplitude": 0.2, "frequency": 0.18},
    "time": {**FOURIER, "functions": 63, "quadrature_points": 1024},
    "analysis": {"type": "frequency_sweep", "frequency_from": 0.13, "frequency_to": 0.25},
}
# The same from 0.05 to 0.5 N at 0.18 Hz, only at 0.18 Hz, and all its motions there.
STOP_AMPLITUDE = {**STOP, "analysis": {"type": "amplitude_sweep", "amplitude_from": 0.05, "amplitude_to": 0.5}}
STOP_RESPONSE = {**STOP, "analysis": {"type": "forced_response"}}
STOP_MOTIONS = {**{key: STOP[key] for key in ("structure", "contact", "forcing")}, "analysis": {"type": "motions"}}

# Three masses of 2 kg between springs of 1e6 N/m, free at the end; the last two touch obstacles.
CHAIN = {
    "structure": {"type": "matrices", "mass": 2.0 * np.eye(3), "contact_dofs": [2, 3], "modal_damping": 0.01,
                  "stiffness": 1e6 * np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])},
    "contact": {"law": "linear", "stiffness": 1e7, "gap": 1e-4},
    "forcing": {"load_dofs": [3], "amplitude": 100.0, "frequency": 50.0},
    "time": {**FOURIER, "functions": 32},
    "analysis": {"type": "forced_response"},
}

# Two masses with five short contacts in a period, between stops of 456 to 1927 kN/m. The balance of 63 functions errs
# by 0.6 % and is unstable with a multiplier of 4.8; the structure is stable.
TWO_MASSES = {
    "structure": {"type": "matrices", "mass": np.diag([0.6279173363755336, 2.1098921735191771]),
                  "stiffness": np.diag([7431.6088486205153, 7768.5984198501328]),
                  "damping": np.array([[2.6716230790832305, 0.10613642184992771],
                                       [0.10613642184992771, 5.0503342967785834]])},
    "contact": {"law": "linear", "stiffness": 1.0, "gap": 0.0, "pairs": [
        {"dofs": [1], "law": "exponential", "constant": 362.4734199610997, "exponent": 12506.293532321932,
         "gap": 0.00011183162081386775},
        {"dofs": [2], "law": "clearance", "stiffness": 1927029.124852406, "gap": 1.521361593455108e-05,
         "stiffness_below": 456189.4743533799, "gap_below": 1.158036679384574e-06}]},
    "forcing": {"load_dofs": [1], "amplitude": 0.6522603106486901, "frequency": 14.77656632196452, "terms": [
        {"harmonic": 2, "amplitude": -0.3922260723374983, "dofs": [2], "phase": 55.27044072172913},
        {"harmonic": 2, "amplitude": -0.4652582418074515, "dofs": [2], "phase": -74.80543042487284},
        {"harmonic": 2, "amplitude": -0.30127713897442704, "dofs": [1], "phase": 0.6755242496654148}]},
    "time": {**FOURIER, "functions": 63, "quadrature_points": 512},
    "analysis": {"type": "forced_response", "phases": True},
}


# Two masses of which one touches a stop, many times as stiff, from below. The curve of 63 functions turns hundreds of
# times among its samples, and the balance has most of its special points many times.
ZIGZAG = {
    "structure": {"type": "matrices", "mass": np.diag([1.04958, 0.68392]),
                  "stiffness": np.array([[7779.57, -2494.49], [-2494.49, 2494.49]]),
                  "damping": np.array([[2.52296, -0.51260], [-0.51260, 1.11490]])},
    "contact": {"law": "linear", "stiffness": 8.705e5, "gap": 0.32658e-3,
                "pairs": [{"dofs": [2], "coefficients": [-1.0]}]},
    "forcing": {"load_dofs": [1], "amplitude": 0.117861,
                "terms": [{"harmonic": 3, "amplitude": 0.0243437, "dofs": [2], "phase": -155.163}]},
    "time": {**FOURIER, "functions": 63, "quadrature_points": 512},
    "analysis": {"type": "frequency_sweep", "frequency_from": 3.506, "frequency_to": 14.32},
}

#: Columns of sweep.csv for one contact.
COLUMNS_OF_A_CURVE = ["frequency_Hz", "max_displacement_m", "rms_displacement_m", "min_displacement_m",
                      "max_abs_displacement_m", "max_contact_force_N", "contact_fraction", "vibration_m",
                      "rms_vibration_m", "unstable", "contacts"]


@functools.cache
def _kept():
    """The files of the records, until the tests end."""
    return tempfile.TemporaryDirectory(prefix="solved_scenes")


_records, _folders = {}, {}


def solved(scene, overrides=None, unset=(), start_from=None):
    """The record of a scene; tests of the same scene share it."""
    key = repr((scene, overrides, unset, start_from))
    if key not in _records:
        _records[key] = wavebalance.run(scene, overrides, unset=unset, start_from=start_from)
    return _records[key]


def folder_of(record):
    """The folder with the files of a record."""
    if record not in _folders:
        _folders[record] = Path(tempfile.mkdtemp(dir=_kept().name))
        record.write(_folders[record])
    return _folders[record]


def table_of(file):
    """The columns of a file of numbers."""
    table = np.genfromtxt(file, delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


def rows_of(table):
    """How many rows a table of the summary has."""
    return len(next(iter(table.values()), ()))


def where(table, **values):
    """The rows of a table of the summary that have these values."""
    kept = [i for i in range(rows_of(table)) if all(table[name][i] == value for name, value in values.items())]
    return {name: np.array([column[i] for i in kept]) for name, column in table.items()}


def warns(record, part):
    return any(part in warning for warning in record.warnings)


def relative_rms_error(values, reference):
    return np.linalg.norm(np.subtract(values, reference)) / np.linalg.norm(reference)


def refusal(scene, overrides=None, unset=()):
    """The error that a scene is refused with."""
    try:
        wavebalance.check(scene, overrides, unset=unset)
    except wavebalance.SceneError as error:
        return error
    raise AssertionError(f"was not refused: {overrides}")


def figure_of(record, name=None):
    """A picture of a record as in its page; by default of its motion or curve."""
    (first,) = [name] if name else [one for one in ("response", "sweep") if getattr(record, one)]
    text = (folder_of(record) / f"{first}.figure.js").read_text()
    return json.loads(text[text.index("] = {") + 4 :].rstrip("; \n"))



def outcome_of(record):
    """The sentences of its page on the results and their accuracy."""
    page = (folder_of(record) / "report.html").read_text()
    return [sentence for title in ("Results", "Accuracy") for sentence in sentences_of(page, title)]


def sentences_of(page, title):
    """The sentences of the first paragraph or list of a section of a page; none without the section."""
    body = re.search(f"<h2>{title}</h2>\n<(p|ul)>(.*?)</\\1>", page, re.S)
    text = re.sub(r"</li>\s*<li>", " ", body.group(2)) if body else ""
    return re.split(r"(?<=\.) (?=[A-Z])", html.unescape(re.sub("<[^>]*>", "", text)).strip()) if body else []
