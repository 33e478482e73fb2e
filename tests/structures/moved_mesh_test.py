"""Meshes of structures of matrices, whose nodes move with the rows that the dof map gives them."""

import tomllib

import numpy as np
import pytest
import scipy.io
from structure_scenes import CHAIN, MATRICES, changed, node_displacements, refused

import wavebalance as wb

MESHED = changed(CHAIN, ("contact_dofs = [2, 3]", 'contact_dofs = [2, 3]\ndof_map = "chain.dof"\nmesh = "chain.inp"'))
# Along z; node 4 is clamped, and has no row.
MESH = """*NODE
4, 0, 0, 0
1, 0, 0, 1
2, 0, 0, 2
3, 0, 0, 3
*ELEMENT, TYPE=B31
1, 4, 1
2, 1, 2
3, 2, 3
"""


@pytest.fixture(autouse=True)
def meshed_chain(chain_files):
    (chain_files / "chain.dof").write_text("1.3\n2.3\n3.3\n")
    (chain_files / "chain.inp").write_text(MESH)
    return chain_files


def written(scene, folder, overrides):
    """Solves a scene; at each of its instants the rows (mtx) and nodes x 3 (vtu)."""
    record = wb.run(scene, {"analysis.phases": False, "analysis.stability": False, **overrides}, output=folder)
    assert record.converged, record.status
    rows = scipy.io.mmread(folder / "motion.mtx").T
    return rows, [node_displacements(folder / f"motion_{i:04d}.vtu") for i in range(len(rows))]


def test_nodes_move_with_their_rows(tmp_path):
    rows, nodes = written(MESHED, tmp_path / "out", {"analysis.motion_points": 4})
    for u, moved in zip(rows, nodes):
        expected = np.zeros((4, 3))
        expected[:3, 2] = u
        np.testing.assert_array_equal(moved, expected)
        assert np.abs(u).min() > 0.0


def test_meshes_are_written_for_paraview_beside_the_rows(tmp_path):
    written(MESHED, tmp_path / "out", {"analysis.motion_points": 4})
    names = {one.name for one in (tmp_path / "out").glob("motion*")} - {"motion.body.js"}
    assert names == {"motion.mtx", "motion.pvd"} | {f"motion_000{i}.vtu" for i in range(4)}
    assert 'NumberOfPoints="4" NumberOfCells="3"' in (tmp_path / "out" / "motion_0000.vtu").read_text()
    assert tomllib.loads(wb.complete(MESHED))["analysis"]["motion_points"] == 32
    assert tomllib.loads(wb.complete(CHAIN))["analysis"].get("motion_points", 0) == 0


def test_a_node_takes_the_mean_of_rows_of_one_name(meshed_chain, tmp_path):
    (meshed_chain / "chain.dof").write_text("1.3\n2.3\n2.3\n")
    rows, nodes = written(MESHED, tmp_path / "out", {"analysis.motion_points": 4})
    for u, moved in zip(rows, nodes):
        assert moved[1, 2] == pytest.approx(0.5 * (u[1] + u[2]), rel=1e-15, abs=0.0)


@pytest.mark.parametrize("name, text, allowed", [
    ("other.inp", "*NODE\n7, 0, 0, 0\n8, 0, 0, 1\n*ELEMENT, TYPE=B31\n1, 7, 8\n",
     "has none of the nodes of structure.dof_map"),
    ("empty.inp", "*HEADING\n", "there is no element"),
    ("missing.inp", None, "missing.inp"),
])
def test_a_mesh_that_does_not_fit_is_refused(meshed_chain, name, text, allowed):
    if text is not None:
        (meshed_chain / name).write_text(text)
    refused(MESHED, "structure.mesh", allowed, overrides={"structure.mesh": name})


def test_a_mesh_needs_a_map():
    refused(changed(MESHED, ('dof_map = "chain.dof"\n', "")), "structure.mesh", "structure.dof_map")


def test_clamped_nodes_of_the_bracket_stay_and_others_move_with_their_rows(tmp_path):
    rows, nodes = written(MATRICES / "bracket" / "bracket.toml", tmp_path / "out", {
        "structure.mesh": "bracket.inp", "analysis.motion_points": 2, "time.functions": 15})
    names = (MATRICES / "bracket" / "bracket.dof").read_text().split()
    places = [(int(node) - 1, int(axis) - 1) for node, axis in (one.split(".") for one in names)]
    assert len(set(places)) == len(places) == rows.shape[1]
    for u, moved in zip(rows, nodes):
        expected = np.zeros_like(moved)
        expected[tuple(np.transpose(places))] = u
        np.testing.assert_array_equal(moved, expected)
        assert np.count_nonzero(~moved.any(axis=1)) == len(moved) - len({node for node, _ in places}) > 0


GMSH = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 0 0
1 0 0 0 0 0 3 0 0
$EndEntities
$Nodes
1 4 1 4
1 1 0 4
1
2
3
4
0 0 1
0 0 2
0 0 3
0 0 0
$EndNodes
$Elements
1 3 1 3
1 1 1 3
1 4 1
2 1 2
3 2 3
$EndElements
"""


def test_a_mesh_of_gmsh_moves_as_that_of_calculix(meshed_chain, tmp_path):
    _, expected = written(MESHED, tmp_path / "inp", {"analysis.motion_points": 4})
    (meshed_chain / "chain.msh").write_text(GMSH)
    wb.convert_mesh("chain.msh", "gmsh.inp")
    _, nodes = written(MESHED, tmp_path / "msh", {"analysis.motion_points": 4, "structure.mesh": "gmsh.inp"})
    np.testing.assert_array_equal(nodes, expected)
    with pytest.raises(FileExistsError, match="gmsh.inp"):
        wb.convert_mesh("chain.msh", "gmsh.inp")
    (meshed_chain / "bad.msh").write_text("no mesh")
    with pytest.raises(ValueError, match="bad.msh"):
        wb.convert_mesh("bad.msh", "other.inp")
    assert not (meshed_chain / "other.inp").exists()
