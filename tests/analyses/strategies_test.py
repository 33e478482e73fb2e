"""Each strategy of the solvers solves a case that those before it do not."""

import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
import wavebalance as wb
from rods_and_bars import warns

sys.path.append(str(Path(__file__).resolve().parents[2] / "docs" / "recipes"))
from beams import bending

CHAIN, RIGID_BAR = "extremes/chain.toml", "jones_legrand_2014/case1_rigid.toml"


@pytest.mark.parametrize("strategy, scene, changes", [
    ("newton", CHAIN, {"contact.stiffness": 1e5}),
    ("gap_continuation", CHAIN, {}),
    ("settling", CHAIN, {"contact.gap": -3e-3, "contact.stiffness": 1e7}),
    ("residual_homotopy", RIGID_BAR, {"time.trial": "haar", "time.weight": "fourier"}),
])
def test_the_strategy_is_the_first_that_solves_its_scene(strategy, scene, changes, scenes):
    record = wb.run(scenes / scene, {**changes, "analysis.stability": False, "analysis.phases": False})
    assert record.converged, record.status
    assert record.summary["strategy"] == strategy


# The motion without contact would press 80 of 100 stops with 800 times the force that moves the chain.
def test_a_hundred_contacts_are_reached_from_soft_ones():
    n = 100
    spring = 1e4 * n
    stiffness = spring * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    stiffness[-1, -1] = spring
    first = np.sqrt(np.linalg.eigvalsh(n * stiffness)[0]) / 2 / np.pi
    record = wb.run({
        "structure": {"type": "matrices", "mass": np.eye(n) / n, "stiffness": stiffness, "modal_damping": 0.02,
                      "contact_dofs": list(range(1, n + 1))},
        "contact": {"law": "linear", "stiffness": 1e4, "gap": [3e-4 * (i + 1) / n for i in range(n)]},
        "forcing": {"load_dofs": [n], "amplitude": 1.0, "frequency": first},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 15, "quadrature_points": 64},
        "analysis": {"stability": False, "phases": False}})
    assert record.converged, record.status
    assert record.summary["strategy"] == "stiffness_continuation"


def grid(amplitude):
    """Eight springs press a rod of 1 m against two dimples each. The motion without contact is a hundred times as large
    as what the grid leaves of it, and opens all contacts."""
    section = 100e9 * np.pi / 64 * (0.0095**4 - 0.0083**4), 9000 * np.pi / 4 * 0.0095**2  # N m^2, kg/m: filled
    mass, stiffness = (matrix[2:, 2:] for matrix in bending(np.linspace(0.0, 1.0, 26), *section))
    pairs = []
    for level, row in enumerate(range(3, 51, 6)):
        gap = -2e-6 if level % 2 else 5e-6
        pairs += [{"dofs": [row], "side": "positive", "stiffness": 1e5, "gap": -1e-4},
                  *({"dofs": [beside], "side": "negative", "stiffness": 1e6, "gap": gap} for beside in (row - 2, row + 2))]
    return {
        "structure": {"type": "matrices", "mass": mass, "stiffness": stiffness, "modal_damping": 0.01},
        "contact": {"law": "linear", "pairs": pairs}, "forcing": {"load_dofs": [49], "amplitude": amplitude, "frequency": 30.0},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 128},
        "analysis": {"type": "forced_response", "outputs": [*range(1, 51)], "stability": False, "phases": False}}


def unbalanced_forces(scene, motion):
    """Residual force of each row and harmonic of a motion at 128 instants, without its load; and the contact forces."""
    mass, stiffness = (scene["structure"][name] for name in ("mass", "stiffness"))
    squares, modes = scipy.linalg.eigh(stiffness, mass)
    damping = mass @ modes @ np.diag(0.02 * np.sqrt(squares)) @ modes.T @ mass  # modes without contact
    pressed = np.zeros_like(motion)
    for pair in scene["contact"]["pairs"]:
        side, row = 1.0 if pair["side"] == "positive" else -1.0, pair["dofs"][0] - 1
        pressed[row] += side * pair["stiffness"] * np.maximum(side * motion[row] - pair["gap"], 0.0)
    moved, contact = (2.0 / 128 * np.fft.rfft(samples)[:, :16] for samples in (motion, pressed))
    omega = 2.0 * np.pi * scene["forcing"]["frequency"] * np.arange(16)
    forces = stiffness @ moved + 1j * omega * (damping @ moved) - omega**2 * (mass @ moved) + contact
    forces[48, 1] -= scene["forcing"]["amplitude"]
    return forces, contact


# All contacts are springs up to 2.28 N. Then the last dimple opens. With contacts that are closed at rest as springs of
# the structure, its opening is what is left to find.
@pytest.mark.parametrize("amplitude, strategy, opens", [(0.3, "settling", False), (3.0, "load_continuation", True),
                                                        (7.0, "settling", True)])
def test_the_contacts_of_a_grid_are_reached_from_rest(amplitude, strategy, opens):
    scene = grid(amplitude)
    record = wb.run(scene)
    assert record.converged, record.status
    assert record.summary["strategy"] == strategy
    motion = np.array([record.outputs[f"row_{row}_m"][::8] for row in range(1, 51)])
    forces, contact = unbalanced_forces(scene, motion)
    assert np.abs(forces).max() < 1e-8  # N
    assert (np.abs(contact[:, 2:]).max() > 0.1) == opens


# From rest this chain converges to a motion with the forcing period, near which 31 functions have no solution.
def test_a_balance_that_stalls_leaves_the_exact_motion_that_the_structure_settles_to(scenes):
    record = wb.run(scenes / CHAIN, {"contact.law": "exponential", "contact.constant": 1e5, "contact.exponent": 1e3,
                                     "contact.gap": -1e-3, "forcing.frequency": 45}, unset=["contact.stiffness"])
    assert record.converged and record.summary["solved_by"] == "exact"
    assert record.summary["attractor_periods"] == 1
    assert warns(record, "do not hold this motion")
