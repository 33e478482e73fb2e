"""The results that the tests of this folder read."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "report" / "tests"))


@pytest.fixture(scope="session")
def results():
    """The folder of the paper."""
    from paper_results import Results
    return Results.of("jones_legrand_2014")
