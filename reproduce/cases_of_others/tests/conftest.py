"""Common parts of the tests of the cases."""

import os
import sys
from pathlib import Path

import pytest

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small matrices gain nothing from threads
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))


@pytest.fixture
def solve(tmp_path):
    """Runs a scene of the cases with arguments; returns the run."""
    import cases
    counter = iter(range(100))

    def run(scene, *arguments):
        words = [word for one in arguments for word in ([one] if one.startswith("--") else ["--set", one])]
        return cases.Run(os.environ["WAVEBALANCE_COMMAND"], scene, words, tmp_path / str(next(counter)))

    return run
