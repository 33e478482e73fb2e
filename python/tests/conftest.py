"""Common parts of several tests."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse

import wavebalance as wb

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes"

BAR = {
    "structure": {
        "type": "bar",
        "youngs_modulus": 70e9,
        "density": 2700.0,
        "area": 25e-4,
        "length": 1.0,
        "elements": 10,
        "stiffness_damping": 1e-4,
    },
    "contact": {"law": "linear", "stiffness": 1e9, "gap": 1e-3},
    "forcing": {"amplitude": 250e3, "frequency": 150.0},
    "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 128},
}


@pytest.fixture
def bar():
    """A bar against a stop, as a dictionary that a test may change."""
    return {section: dict(keys) for section, keys in BAR.items()}


@pytest.fixture(scope="session")
def oscillator():
    """Makes a mass of 1 kg on a spring of 1 N/m with a contact, of which a test may change each number."""

    def make(load=1.0, damping=0.1, mass=1.0, stiffness=1.0, **more):
        return wb.Structure([[mass]], [[damping]], [[stiffness]], [load], contacts=[0], **more)

    return make


@pytest.fixture
def chain():
    """Makes mass, damping, stiffness and load of masses between springs, fixed at both ends and driven at the first."""

    def make(size=6):
        stiffness = 1e4 * scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(size, size))
        load = np.zeros(size)
        load[0] = 10.0
        return scipy.sparse.identity(size), 1e-4 * stiffness, stiffness, load

    return make


@pytest.fixture
def scenes():
    """The folder of the scenes of this project."""
    return SCENES


@pytest.fixture
def command(tmp_path):
    """Runs the command with arguments in a temporary folder and returns what it ended with."""

    def run(*arguments):
        program = os.environ["WAVEBALANCE_COMMAND"]
        own = {key: value for key, value in os.environ.items() if key != "LD_PRELOAD"}  # the command has its sanitizers
        return subprocess.run([program, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True, check=False, env=own)

    return run
