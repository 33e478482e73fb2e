"""The files that scenes of structures name."""

import pytest
from structure_scenes import CHAIN_MASS, CHAIN_STIFFNESS


@pytest.fixture
def chain_files(matrix, tmp_path, monkeypatch):
    """The current folder, with the matrices of the chain and a load on its last mass."""
    monkeypatch.chdir(tmp_path)
    matrix("k.mtx", CHAIN_STIFFNESS.tolist())
    matrix("m.mtx", CHAIN_MASS.tolist())
    matrix("f.mtx", [[0.0], [0.0], [1.0]])
    return tmp_path
