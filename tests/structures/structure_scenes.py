"""Scenes of structures of which a test changes one thing, and what their tests compare them by."""

import base64
import re
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

import wavebalance as wb

MATRICES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes" / "matrices"

# Three masses between springs, free at the end; the last two touch obstacles.
CHAIN_MASS = 2.0 * np.eye(3)
CHAIN_STIFFNESS = 1e6 * np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])

# The number at the end of a line is that line's.
CHAIN = """[structure]
type = "matrices"               # 2
mass = "m.mtx"                  # 3
stiffness = "k.mtx"             # 4
contact_dofs = [2, 3]           # 5
modal_damping = 0.01            # 6
[contact]
law = "linear"                  # 8
stiffness = 1e7                 # 9
gap = 1e-4                      # 10
[forcing]
load_dofs = [3]                 # 12
amplitude = 100.0               # 13
frequency = 50.0                # 14
[time]
trial = "fourier"
weight = "fourier"
functions = 32
[analysis]
type = "forced_response"        # 20
"""

BAR = """[structure]
type = "bar"                    # 2
youngs_modulus = 70e9           # 3
density = 2700                  # 4
area = 25e-4                    # 5
length = 1.0                    # 6
elements = 25                   # 7
stiffness_damping = 1e-4        # 8
[contact]
law = "exponential"             # 10
constant = 1e8                  # 11
exponent = 50.0                 # 12
gap = 1e-3                      # 13
[forcing]
amplitude = 250e3               # 15
frequency = 150.0               # 16
[time]
trial = "fourier"               # 18
weight = "fourier"              # 19
functions = 64                  # 20
quadrature_points = 256         # 21
[analysis]
type = "forced_response"        # 23
"""

ROD = """[structure]
type = "bar"
youngs_modulus = 2.1e11
density = 7800.0
area = 9e-4
length = 1.0
elements = 20
lumped_mass_fraction = 0.5
[contact]
law = "rigid"
gap = 1e-3
[analysis]
type = "nonlinear_mode"
points = 200
"""

BLADE = """[structure]
type = "blade"                  # 2
[contact]
law = "rigid"                   # 4
gap = 1e-3                      # 5
[analysis]
type = "nonlinear_mode"         # 7
"""


def changed(text, *pairs):
    """The text with one occurrence of each first word, which must be there, replaced by the second."""
    for old, new in pairs:
        assert old in text, f"{old} is not in\n{text}"
        text = text.replace(old, new, 1)
    return text


def terms(*each):
    """Tables [[forcing.terms]], to append to a scene."""
    return "".join(f"[[forcing.terms]]\n{one}\n" for one in each)


def refused(scene, key, *parts, line=None, overrides=None, unset=()):
    """Asserts that a scene is refused at a key, and at a line, with all parts in what is allowed."""
    with pytest.raises(wb.SceneError) as raised:
        wb.check(scene, overrides, unset=unset)
    error = raised.value
    assert error.key == key, str(error)
    assert line is None or error.line == line, str(error)
    for part in parts:
        assert part in error.allowed
    return error


def solved(scene, overrides=None, unset=()):
    """The record of the balance alone, which must converge."""
    record = wb.run(scene, {"analysis.phases": False, "analysis.stability": False, **(overrides or {})}, unset=unset)
    assert record.converged, record.status
    return record


def stepped(scene, overrides=None, unset=()):
    """The record of the same motion by time stepping, which must settle."""
    record = wb.run(scene, {"analysis.type": "time_stepping", **(overrides or {})}, unset=unset)
    assert record.converged, record.status
    return record


def column(record, name):
    """A quantity of the contacts over a period, contacts x points."""
    if not record.contacts:
        return record.response[name][None, :]
    return record.contacts[name].reshape(-1, record.summary["contacts"]).T


def displacements(record):
    return column(record, "displacement_m")


def forces(record):
    return column(record, "contact_force_N")


def distance(found, expected):
    """The norm of a difference over that of what is expected."""
    assert np.shape(found) == np.shape(expected)
    return np.linalg.norm(found - expected) / np.linalg.norm(expected)


def modal_damping(stiffness, mass, ratio):
    """The damping that is this ratio of the critical one in each mode."""
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    return mass @ shapes @ np.diag(2.0 * ratio * np.sqrt(squares)) @ shapes.T @ mass


def node_displacements(file):
    """The displacement of each node in a file for ParaView, nodes x 3."""
    text = file.read_text()
    assert '<DataArray type="Float64" Name="displacement" NumberOfComponents="3" format="appended" offset="0"/>' in text
    points = int(re.search('NumberOfPoints="([0-9]+)"', text)[1])
    begin = text.index("_", text.index('<AppendedData encoding="base64">')) + 1
    block = base64.b64decode(text[begin:begin + 4 * -(-(8 + 24 * points) // 3)])
    assert int.from_bytes(block[:8], "little") == 24 * points
    return np.frombuffer(block[8:8 + 24 * points], "<f8").reshape(points, 3)
