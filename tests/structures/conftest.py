"""The files that scenes of structures name."""

import pytest
from overhung_disk import FILES
from structure_scenes import CHAIN_MASS, CHAIN_STIFFNESS


@pytest.fixture
def chain_files(matrix, tmp_path, monkeypatch):
    """The current folder, with the matrices of the chain and a load on its last mass."""
    monkeypatch.chdir(tmp_path)
    matrix("k.mtx", CHAIN_STIFFNESS.tolist())
    matrix("m.mtx", CHAIN_MASS.tolist())
    matrix("f.mtx", [[0.0], [0.0], [1.0]])
    return tmp_path


@pytest.fixture
def rotor_files(matrix, tmp_path, monkeypatch):
    """Writes a matrix into the current folder, which has the matrices of the overhung disk."""
    monkeypatch.chdir(tmp_path)
    for name, rows in FILES:
        matrix(f"{name}.mtx", rows.tolist())
    return matrix
