"""Each strategy of the solvers solves a case that those before it do not."""

import numpy as np
import pytest
import wavebalance as wb
from rods_and_bars import warns

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


# From rest this chain settles to a motion of the load's period, which 31 functions have no solution near.
def test_a_balance_that_stalls_says_that_the_structure_settles_to_a_motion_of_this_period(scenes):
    record = wb.run(scenes / CHAIN, {"contact.law": "exponential", "contact.constant": 1e5, "contact.exponent": 1e3,
                                     "contact.gap": -1e-3, "forcing.frequency": 45}, unset=["contact.stiffness"])
    assert not record.converged
    assert record.summary["attractor_periods"] == 1
    assert warns(record, "converges to a motion of this period")
