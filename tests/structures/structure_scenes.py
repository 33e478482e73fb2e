"""Scenes of structures of which a test changes one thing, and what their tests compare them by."""

import base64
import re
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from scene_texts import BAR, CHAIN, ROD

import wavebalance as wb

MATRICES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes" / "matrices"

# Three masses between springs, free at the end; the last two touch obstacles.
CHAIN_MASS = 2.0 * np.eye(3)
CHAIN_STIFFNESS = 1e6 * np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])

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
    """The record of only the balance, which must converge."""
    record = wb.run(scene, {"analysis.phases": False, "analysis.stability": False, **(overrides or {})}, unset=unset)
    assert record.converged, record.status
    return record


def stepped(scene, overrides=None, unset=()):
    """The record of the same motion by time stepping, which must converge."""
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
    """The norm of a difference over the norm of the expected value."""
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
