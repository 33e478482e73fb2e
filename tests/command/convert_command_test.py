"""`wavebalance convert`: files of other codes as Matrix Market files and a dof map, which a scene names."""

import numpy as np
import pytest
import scipy.io

import wavebalance as wb

MATRIX_INPUT = "40,1, 40,1, 2e3\n7,1, 40,1, -1e3\n7,1, 7,1, 1e3\n7,1, 1,1, -5.0\n1,1, 1,1, 1e36\n"
MASS = "40,1, 40,1, 2.0\n7,1, 7,1, 1.0\n"
LOAD = "*CLOAD, REAL\n40,1, 3.0\n"
ANSYS = """Damping matrix from ANSYS FULL file                                     C
             9             4             3             2             0
RSA                        3             3             2             0
(1I14)          (1I14)          (1D25.15)
             1
             3
             3
             3
             1
             3
    2.000000000000000D+00
   -1.000000000000000D+00
"""
SCENE = """
[structure]
type = "matrices"
mass = "out/mass.mtx"
stiffness = "out/stiffness.mtx"
dof_map = "out/dof_map.csv"
contact_dofs = ["node 7 x"]
[contact]
law = "none"
[forcing]
load = "out/load.mtx"
amplitude = 2.0
frequency = 1.0
[time]
trial = "fourier"
weight = "fourier"
functions = 7
[analysis]
type = "forced_response"
"""


@pytest.fixture
def job(tmp_path):
    for name, text in (("job_STIF1.mtx", MATRIX_INPUT), ("job_MASS1.mtx", MASS), ("job_LOAD1.mtx", LOAD)):
        (tmp_path / name).write_text(text)
    return ["job_STIF1.mtx", "job_MASS1.mtx", "job_LOAD1.mtx"]


def test_a_scene_names_what_conversion_writes(command, job, tmp_path, run):
    record = command("convert", *job, "--output", "out")
    assert record.code == 0, record.errors
    assert sorted(file.name for file in record.folder.iterdir()) == ["dof_map.csv", "load.mtx", "mass.mtx", "stiffness.mtx"]
    for part in ('structure.mass = "mass.mtx"', 'forcing.load = "load.mtx"', "stiffness.mtx  2 x 2, of job_STIF1.mtx"):
        assert part in record.text
    assert (record.folder / "dof_map.csv").read_text() == "node,direction\n7,x\n40,x\n"
    stiffness = scipy.io.mmread(record.folder / "stiffness.mtx").toarray()
    assert stiffness.tolist() == [[1e3, -1e3], [-1e3, 2e3]]
    omega = 2.0 * np.pi
    expected = np.linalg.solve(stiffness - omega**2 * np.diag([1.0, 2.0]), [0.0, 6.0])[0]
    (tmp_path / "scene.toml").write_text(SCENE)
    solved = wb.run(tmp_path / "scene.toml", {"analysis.stability": False})
    assert solved.summary["rms_displacement_m"] == pytest.approx(abs(expected) / np.sqrt(2.0), rel=1e-12)


def test_no_file_is_overwritten(command, job, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mass.mtx").write_text("mine")
    record = command("convert", *job, "--output", "out")
    assert record.code == 2
    assert "mass.mtx exists and is not overwritten; --output names another folder" in record.errors
    assert [file.name for file in record.folder.iterdir()] == ["mass.mtx"]
    assert (tmp_path / "out" / "mass.mtx").read_text() == "mine"


def test_a_map_of_ansys_names_the_rows_of_its_matrices(command, tmp_path):
    (tmp_path / "c.matrix").write_text(ANSYS)
    (tmp_path / "c.mapping").write_text("  Matrix Eqn        Node     DOF\n   1   9  UX\n   2   9  UY\n   3   4  ROTZ\n")
    record = command("convert", "c.matrix", "c.mapping", "--output", "out")
    assert record.code == 0, record.errors
    found = wb.read_matrices([tmp_path / "c.matrix", tmp_path / "c.mapping"])
    assert found.rows == ("node 9 x", "node 9 y", "node 4 rz")
    expected = [[2.0, 0.0, -1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]
    assert found.damping.toarray().tolist() == scipy.io.mmread(record.folder / "damping.mtx").toarray().tolist() == expected
    assert (record.folder / "dof_map.csv").read_text() == "node,direction\n9,x\n9,y\n4,rz\n"


@pytest.mark.parametrize("more, expected", [
    (["job_STIF1.mtx"], "it holds stiffness, as job_STIF1.mtx does; expected each once"),
    (["k.dof", "more.dof"], "more.dof: it is a second dof map; expected one"),
    (["k.dof"], "job_STIF1.mtx: the matrix has an entry at node 40 x, which the rows have 0 times; expected once"),
    (["damp.mtx"], "damp.mtx: it names no nodes, as another file does; expected a dof map among the files"),
    (["none.mtx"], "none.mtx: the file cannot be opened for reading"),
])
def test_files_that_do_not_fit_each_other_are_named_and_nothing_is_written(command, job, tmp_path, more, expected):
    (tmp_path / "k.dof").write_text("7.1\n1.1\n")
    (tmp_path / "more.dof").write_text("7.1\n")
    (tmp_path / "damp.mtx").write_text("1 1 1.0\n")
    record = command("convert", *job, *more, "--output", "out")
    assert record.code == 2
    assert expected in record.errors
    assert not record.folder.exists()
