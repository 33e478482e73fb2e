"""Matrices of other codes, as their files have them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core

__all__ = ["MatrixFiles", "convert_mesh", "read_matrices"]

PathLike = str | os.PathLike[str]


@dataclass(frozen=True)
class MatrixFiles:
    """Content of files of matrices, all in the same rows.

    Attributes
    ----------
    matrices: dict
        By what they are: ``"mass"``, ``"stiffness"``, ``"damping"``, ``"structural_damping"`` and others by the name in
        their file, n × n ``scipy.sparse.csc_matrix`` in the units of the file; ``"load"``, n values, or n × cases.
    rows: tuple of str or None
        ``"node 18 z"`` of each row; None where no file names nodes.
    nodes, directions: numpy.ndarray or None
        The same apart: n integers, and n texts (x, y, z, rx, ry, rz, scalar).
    """

    matrices: dict[str, Any]
    rows: tuple[str, ...] | None
    nodes: npt.NDArray[np.int32] | None
    directions: npt.NDArray[np.str_] | None

    @property
    def mass(self) -> Any:
        """M, or None."""
        return self.matrices.get("mass")

    @property
    def stiffness(self) -> Any:
        """K, or None."""
        return self.matrices.get("stiffness")

    @property
    def damping(self) -> Any:
        """C, or None."""
        return self.matrices.get("damping")

    @property
    def load(self) -> Any:
        """Forces, or None."""
        return self.matrices.get("load")

    def row(self, name: str) -> int:
        """The row, from 0, of ``"node 18 z"``. Raises KeyError for a name that no row has."""
        try:
            return (self.rows or ()).index(name)
        except ValueError:
            raise KeyError(f"{name!r} is no row; the files name {', '.join((self.rows or ())[:3]) or 'no nodes'}, ...") from None


def read_matrices(files: PathLike | Iterable[PathLike]) -> MatrixFiles:
    """Reads matrices, loads and at most one dof map in the formats of other codes, known by their content.

    Parameters
    ----------
    files:
        One path or several: Matrix Market, CalculiX, Abaqus (``*MATRIX OUTPUT``), Harwell-Boeing (Ansys, LS-DYNA), Nastran
        (DMIG, OUTPUT4), and a dof map (.dof, .mapping, .csv). ``"job.pch#KAAX"`` is one matrix of a file.

    Returns
    -------
    MatrixFiles
        Rows follow the dof map, or all nodes that the files name, ascending. Rows that the stiffness marks as held
        (1e36 on its diagonal, Abaqus) are left out.

    Raises
    ------
    ValueError
        A file that is wrong, with line or record, what was found and what is allowed.
    """
    given = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    found, rows, nodes, directions = _core.read_matrices([os.fspath(one) for one in given])
    matrices = {role: matrix for role, _, matrix in found}
    if "load" in matrices:
        load = matrices["load"].toarray()
        matrices["load"] = load[:, 0] if load.shape[1] == 1 else load
    return MatrixFiles(matrices, None if rows is None else tuple(rows), nodes, None if rows is None else np.array(directions))


def convert_mesh(file: PathLike, output: PathLike) -> None:
    """Writes a mesh of another program as an input file for ``structure.mesh``. Requires meshio.

    Parameters
    ----------
    file:
        A mesh of a format of meshio: Gmsh, VTK, MED, Nastran bulk data, ...
    output:
        A new file, such as ``"pipe.inp"``. Its nodes are numbered from 1 in the order of the mesh, and the dof map must
        use these numbers.

    Raises
    ------
    FileExistsError
        ``output`` is there already.
    ValueError
        meshio cannot read the file.
    """
    import meshio  # an optional package

    if os.path.exists(output):
        raise FileExistsError(f"{os.fspath(output)} is there already; name a new file")
    try:
        mesh = meshio.read(file)
    except (meshio.ReadError, SystemExit) as error:  # meshio itself exits
        raise ValueError(f"{os.fspath(file)} is no mesh that meshio reads: {error}") from None
    mesh.point_sets = mesh.cell_sets = {}
    meshio.write(Path(output), mesh, file_format="abaqus")
