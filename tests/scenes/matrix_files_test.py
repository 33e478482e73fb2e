"""Files of matrices are known by their content, name their nodes where they do, and what is wrong is named."""

import pytest

import wavebalance as wb

SCENE = """
[structure]
type = "matrices"
mass = "{mass}"
stiffness = "{stiffness}"
stiffness_damping = 1e-3
contact_dofs = [2]
[contact]
law = "linear"
stiffness = 5000.0
gap = 1e-3
[forcing]
{load}
amplitude = 1.0
frequency = 2.2
[time]
trial = "fourier"
weight = "fourier"
functions = 31
[analysis]
type = "forced_response"
"""

COORDINATES = "1 1 2e3\n2 1 -1e3\n2 2 1e3\n"
BOTH_TRIANGLES = "1 1 2e3\n1 2 -1e3\n2 1 -1e3\n2 2 1e3\n"
MASS = "1 1 2.0\n2 2 1.0\n"
HARWELL_BOEING = """stiffness of Ansys, full though it says symmetric, with a load
            14             3             4             4             2
RSA                        2             2             4             0
(1I14)          (4I3)           (1D25.15)           (1D25.15)
F                          1             0
             1
             3
             5
  1  2  1  2
    2.000000000000000D+03
   -1.000000000000000D+03
   -1.000000000000000D+03
    1.000000000000000D+03
    5.000000000000000D+00
    0.000000000000000D+00
"""


@pytest.fixture
def solved(run, tmp_path):
    """The record of the scene with its matrices in these texts, under neutral names."""

    def solve(stiffness, load="load_dofs = [1]", mass=MASS):
        (tmp_path / "mass.mtx").write_text(mass)
        (tmp_path / "stiffness.mtx").write_text(stiffness)
        return run(SCENE.format(mass="mass.mtx", stiffness="stiffness.mtx", load=load))

    return solve


def test_a_file_is_read_by_its_content_whatever_its_name_and_with_one_triangle_or_both(solved):
    peaks = [solved(text).summary["max_displacement_m"] for text in (COORDINATES, BOTH_TRIANGLES, HARWELL_BOEING)]
    assert peaks[0] > 0.0
    assert peaks == pytest.approx([peaks[0]] * 3, rel=1e-12)


def test_a_load_is_the_right_hand_side_of_a_harwell_boeing_file(solved):
    scaled = solved(COORDINATES, load="load_dofs = [1]").summary["rms_displacement_m"]
    named = solved(HARWELL_BOEING, load='load = "stiffness.mtx"').summary["rms_displacement_m"]
    assert named > 2.0 * scaled  # 5 N instead of 1 N


# The same two masses as nodes 40 and 7, which comes first.
DMIG = """DMIG    KAAX           0       6       2       0
DMIG*   KAAX                          40               1
*                     40               1 2.000000000D+03
DMIG*   KAAX                           7               1
*                     40               1-1.000000000D+03
*                      7               1 1.000000000D+03
DMIG    MAAX           0       6       2       0
DMIG*   MAAX                          40               1
*                     40               1 2.000000000D+00
DMIG*   MAAX                           7               1
*                      7               1 1.000000000D+00
DMIG    PAX            0       9       2       0                       1
DMIG*   PAX                            1               0
*                     40               1 1.000000000D+00
"""
ABAQUS = "40,1, 40,1, 2e3\n7,1, 40,1, -1e3\n7,1, 7,1, 1e3\n"
ABAQUS_MASS = "40,1, 40,1, 2.0\n7,1, 7,1, 1.0\n"
NAMED = SCENE.replace("[2]", '["node 7 x"]')


@pytest.fixture
def expected(solved):
    summary = solved(COORDINATES).summary
    return pytest.approx(summary["max_displacement_m"], rel=1e-12), pytest.approx(summary["max_contact_force_N"], rel=1e-12)


def answer(record):
    return record.summary["max_displacement_m"], record.summary["max_contact_force_N"]


@pytest.mark.parametrize("load", ['load_dofs = ["node 40 x"]', 'load = "job.pch#PAX:1"', 'load = "job.pch"'])
def test_matrices_of_one_bulk_data_file_are_named_behind_it_and_rows_by_their_nodes(run, tmp_path, expected, load):
    (tmp_path / "job.pch").write_text(DMIG)
    record = run(NAMED.format(mass="job.pch#MAAX", stiffness="job.pch#kaax", load=load), "--copy-inputs")
    assert answer(record) == expected
    assert (record.folder / "input_job.pch").read_text() == DMIG
    again = wb.run(record.folder / "scene.toml")
    assert again.summary["max_displacement_m"] == record.summary["max_displacement_m"]


@pytest.mark.parametrize("rows, contact", [(None, '["node 7 x"]'), (None, "[1]"), ("40.1\n7.1\n", "[2]"), ("5.1\n40.1\n7.1\n", "[3]")])
def test_matrix_input_has_its_rows_by_ascending_nodes_or_in_the_order_of_the_dof_map(run, tmp_path, expected, rows, contact):
    (tmp_path / "k.mtx").write_text(ABAQUS + ("5,1, 5,1, 1e36\n" if rows and "5.1" in rows else ""))
    (tmp_path / "m.mtx").write_text(ABAQUS_MASS)
    (tmp_path / "f.mtx").write_text("*CLOAD, REAL\n40,1, 1.0\n")
    text = SCENE.replace("[2]", contact).format(mass="m.mtx", stiffness="k.mtx", load='load = "f.mtx"')
    if rows:
        (tmp_path / "rows.dof").write_text(rows)
        text = text.replace("stiffness_damping", 'dof_map = "rows.dof"\nstiffness_damping')
    assert answer(run(text)) == expected


@pytest.mark.parametrize("mass, key, named", [
    ("40,1, 40,1, 2.0\n9,1, 9,1, 1.0\n", "structure.mass", "the matrix has an entry at node 9 x, which the rows have 0 times"),
    (MASS, "structure.contact_dofs", "node 3 is not in"),
])
def test_an_entry_or_a_contact_elsewhere_is_named_by_its_node(run, tmp_path, mass, key, named):
    (tmp_path / "k.mtx").write_text(ABAQUS)
    (tmp_path / "m.mtx").write_text(mass)
    scene = NAMED.replace("node 7 x", "node 3 x") if "contact" in key else NAMED
    record = run(scene.format(mass="m.mtx", stiffness="k.mtx", load="load_dofs = [2]"))
    assert record.code == 2
    assert key in record.errors and named in record.errors


@pytest.mark.parametrize("key, place, named", [
    ("stiffness", "job.pch", 'the file holds KAAX, MAAX, PAX; expected the name of one behind it, as "job.pch#KAAX"'),
    ("stiffness", "job.pch#KXX", 'no matrices of the name "KXX"; the file holds KAAX, MAAX, PAX'),
    ("mass", "k.sti", "is 3 x 3; expected 2 x 2"),
    ("dof_map", "rows.dof", "which the rows have 2 times; expected once"),
])
def test_a_place_that_is_none_is_refused_with_those_that_there_are(run, tmp_path, key, place, named):
    (tmp_path / "job.pch").write_text(DMIG)
    (tmp_path / "k.sti").write_text("1 1 1.0\n2 2 1.0\n3 3 1.0\n")
    (tmp_path / "rows.dof").write_text("40.1\n7.1\n40.1\n")
    scene = NAMED.format(mass="job.pch#MAAX", stiffness="job.pch#KAAX", load="load_dofs = [2]").replace("node 7 x", "1")
    record = run(scene, set=[f"structure.{key}={place}"])
    assert record.code == 2
    assert named in record.errors


@pytest.mark.parametrize("text, named", [
    ("$TITLE = CHAIN\nDMIG    KAAX           0       6       4       0\n", "the file was read as DMIG of Nastran"),
    ("       2       2       6       2KAA     1P,3E23.16\n", "the file was read as OUTPUT4 of Nastran"),
    ("1 1 2e3\n1 2 -1e3\n2 1 -2e3\n", "the entry (2, 1) is -2000 and (1, 2) is -1000"),
    (HARWELL_BOEING.replace("-1.0", "-1.5", 1), "the entry (2, 1) is -1500 and (1, 2) is -1000; a symmetric file holds one"),
    ("%%MatrixMarket matrix coordinate real symmetric\n2 2\n", "the file was read as Matrix Market"),
    ("no matrix\n", "the file was read as Matrix Market because of its name"),
])
def test_a_file_that_is_not_read_is_named_with_its_format(solved, text, named):
    record = solved(text)
    assert record.code == 2
    assert "structure.stiffness" in record.errors and named in record.errors
    assert not record.folder.exists()
