"""A rigid law of a pair."""

import copy

import numpy as np
import pytest
import wavebalance as wb

RIGID = {"law": "rigid", "restitution": 0.7, "gap": 2e-3, "dofs": [1]}
SPRING = {"law": "linear", "stiffness": 1e5, "gap": 4e-3, "dofs": [1], "coefficients": [-1.0]}
HAMMER = {
    "structure": {"type": "matrices", "mass": np.eye(1) * 0.05, "stiffness": np.eye(1) * 789.6, "damping": np.eye(1) * 0.25},
    "forcing": {"frequency": 35.0, "terms": [{"kind": "base_acceleration", "amplitude": 100.0, "dofs": [1]}]},
}


def hammer(*pairs, **contact):
    scene = copy.deepcopy(HAMMER)
    scene["contact"] = {**contact, "pairs": list(pairs)}
    return scene


def without(pair, *keys):
    return {key: value for key, value in pair.items() if key not in keys}


@pytest.mark.parametrize("pairs", [[RIGID], [SPRING, RIGID]])
def test_a_rigid_pair_has_the_motion_of_contact_law(pairs):
    own = wb.run(hammer(*pairs))
    shared = [without(pair, "law", "restitution") if pair is RIGID else pair for pair in pairs]
    assert own.converged
    expected = wb.run(hammer(*shared, law="rigid", restitution=0.7))
    np.testing.assert_array_equal(own.response["displacement_m"], expected.response["displacement_m"])
    assert own.response["displacement_m"].max() > 1.9e-3


def test_a_rigid_pair_beside_another_law_of_the_scene_is_refused():
    with pytest.raises(wb.SceneError, match=r'pairs\[1\].law.*rigid beside contact.law = "linear".*or contact.law = "rigid"'):
        wb.run(hammer(RIGID, law="linear", stiffness=1e5))
