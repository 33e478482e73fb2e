"""Matrix input, labels, coordinates, loads and substructures of Abaqus, and rows that it marks as held."""

import numpy as np
import pytest
from code_files import ascending, concentrated_loads, matrix_input, random_structure, substructure

import wavebalance as wb

MASS, DAMPING, STIFFNESS, LABELS = random_structure()
LABELS[2] = (-1, 1)  # an internal node
LOAD = np.zeros(9)
LOAD[[1, 5]] = 5.0, -0.25


@pytest.fixture
def write(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(name, text):
        (tmp_path / name).write_text(text)
        return name

    return write


@pytest.mark.parametrize("separator", [",", ", ", "  "])
def test_matrix_input_names_what_it_holds_by_its_file_and_its_rows_by_nodes(write, separator):
    files = [write("job_STIF1.mtx", "** of a plate\n" + matrix_input(STIFFNESS, LABELS, separator)),
             write("job_MASS1.mtx", matrix_input(MASS, LABELS, separator)),
             write("job_LOAD1.mtx", concentrated_loads(LOAD, LABELS))]
    found = wb.read_matrices(files)
    np.testing.assert_allclose(found.stiffness.toarray(), ascending(STIFFNESS, LABELS), rtol=1e-14)
    np.testing.assert_allclose(found.mass.toarray(), ascending(MASS, LABELS), rtol=1e-14)
    np.testing.assert_array_equal(found.load, ascending(LOAD, LABELS))
    assert list(found.nodes) == [node for node, _ in sorted(LABELS)]
    assert found.rows[0] == "node -1 x"


def test_a_matrix_without_symmetry_says_so(write):
    text = "*MATRIX INPUT, NAME=C, TYPE=UNSYMMETRIC\n2,1, 2,1, 1.0\n2,1, 3,1, 5.0\n3,1, 2,1, -5.0\n"
    found = wb.read_matrices(write("job_DMPV1.mtx", text))
    assert found.damping.toarray().tolist() == [[1.0, 5.0], [-5.0, 0.0]]


WRONG = {
    "short": ("2,1, 2,1, 1.0\n3,1, 3,1\n", 'k.mtx:2: found "3,1, 3,1"; the line must hold node, degree of freedom, node,'),
    "dof": ("2,1, 2,1, 1.0\n3,11, 3,11, 2.0\n", "k.mtx:2: the degree of freedom is 11; it must be in 1..6"),
    "value": ("2,1, 2,1, 1.0\n3,1, 3,1, nan\n", 'k.mtx:2: the value is "nan"; it must be finite'),
    "keyword": ("2,1, 2,1, 1.0\n*STEP\n", 'k.mtx:2: found "*STEP"; the keyword must be *MATRIX INPUT or *CLOAD'),
    "twice": ("2,1, 2,1, 1.0\n2,1, 2,1, 3.0\n", "the entry (node 2 x, node 2 x) is given twice, as 1 and 3"),
    "triangles": ("2,1, 2,1, 1e36\n2,1, 3,1, 1.0\n3,1, 2,1, 1.5\n",
                  "the entry (node 3 x, node 2 x) is 1.5 and (node 2 x, node 3 x) is 1; a symmetric file"),
    "imaginary": ("*CLOAD, IMAGINARY\n2,1, 1.0\n", "has an imaginary part"),
    "nothing": ("*CLOAD, REAL\n", "there is no entry"),
}


@pytest.mark.parametrize("text, expected", WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_named(write, text, expected):
    with pytest.raises(ValueError) as raised:
        wb.read_matrices(write("k.mtx", text))
    assert expected in str(raised.value)
    assert "; the file was read as matrix input of Abaqus" in str(raised.value)


CUT = "the file is cut off"


@pytest.mark.parametrize("headerless", ["labels", "coordinate"])
@pytest.mark.parametrize("end, why", [(-6, "shorter than all before"), ("a row", "no entry on the diagonal")])
def test_a_file_that_is_cut_off_is_refused(write, headerless, end, why):
    # A value without its exponent, -1000 as -1, and a last row without its diagonal.
    entries = [(2, 2, 2e3), (3, 2, -1e3), (3, 3, 2e3), (4, 3, -1e3), (4, 4, 1e3)]
    line = "{},1, {},1, {:.15e}\n" if headerless == "labels" else "{} {} {:.15e}\n"
    text = "".join(line.format(i - (headerless != "labels"), j - (headerless != "labels"), value) for i, j, value in entries)
    whole = wb.read_matrices(write("job_STIF1.mtx", text))
    assert whole.stiffness.shape == (3, 3)
    np.testing.assert_array_equal(wb.read_matrices(write("job_STIF1.mtx", text[:-1])).stiffness.toarray(), whole.stiffness.toarray())
    cut = text[:end] if end != "a row" else "".join(text.splitlines(keepends=True)[:-1])
    with pytest.raises(ValueError, match=why) as raised:
        wb.read_matrices(write("job_STIF1.mtx", cut))
    assert CUT in str(raised.value)


def test_values_that_a_person_wrote_may_be_of_any_length(write):
    found = wb.read_matrices(write("k_stif.mtx", "2,1, 2,1, 1000.0\n3,1, 3,1, 5"))
    np.testing.assert_array_equal(found.stiffness.toarray(), np.diag([1000.0, 5.0]))


@pytest.mark.parametrize("symmetric", [True, False])
def test_a_substructure_has_all_its_matrices_in_a_file(write, symmetric):
    matrices = {"STIFFNESS": STIFFNESS, "MASS": MASS, "VISCOUS DAMPING": DAMPING @ DAMPING.T if symmetric else DAMPING}
    found = wb.read_matrices(write("inner.mtx", substructure(matrices, LABELS, symmetric)))
    for matrix, expected in zip((found.stiffness, found.mass, found.damping), matrices.values(), strict=True):
        np.testing.assert_allclose(matrix.toarray(), ascending(expected, LABELS), rtol=1e-14)
    assert list(found.nodes) == [node for node, _ in sorted(LABELS)]
    assert list(wb.read_matrices("inner.mtx#mass").matrices) == ["mass"]


SMALL = substructure({"STIFFNESS": np.eye(3)}, [(7, 1), (7, 2), (9, 1)])
PARTS = {
    "values": (SMALL[:SMALL.rindex("0.0")], "inner.mtx:12: the matrix of TYPE=stiffness has 4 values; it must have 6 for 3 rows"),
    "nodes": (SMALL.replace("NODES= 2", "NODES= 3"), "lists 2 nodes; *USER ELEMENT says 3"),
    "dofs": (SMALL.replace("\n1, 2\n2, 1\n", "\n"), "the degrees of freedom below *USER ELEMENT are missing"),
    "dof": (SMALL.replace("\n1, 2\n", "\n1, 8\n"), "the degree of freedom is 8; it must be in 1..6"),
    "place": (SMALL.replace("\n2, 1\n", "\n3, 1\n"), "the place of the node is 3; it must be in 1..2"),
    "elements": (SMALL + SMALL, "there is a second *USER ELEMENT; the file must have one"),
    "keyword": (SMALL + "*STEP\n", 'found "*STEP"; the keyword must be *USER ELEMENT or *MATRIX, TYPE='),
    "no matrix": (SMALL[:SMALL.index("*MATRIX")], "there is no *MATRIX"),
}


@pytest.mark.parametrize("text, expected", PARTS.values(), ids=PARTS)
def test_what_is_wrong_with_a_substructure_is_named(write, text, expected):
    with pytest.raises(ValueError) as raised:
        wb.read_matrices(write("inner.mtx", text))
    assert expected in str(raised.value)
    assert "; the file was read as a substructure of Abaqus or CalculiX" in str(raised.value)


# A rod of three elements, whose first node is held: consistent masses couple it with the next one.
ROD_STIFFNESS = 1e6 * (np.diag([1.0, 2.0, 2.0, 1.0]) - np.eye(4, k=1) - np.eye(4, k=-1))
ROD_MASS = 0.5 * (np.diag([2.0, 4.0, 4.0, 2.0]) + np.eye(4, k=1) + np.eye(4, k=-1))
ROD_LABELS = [(8, 1), (3, 1), (12, 1), (5, 1)]  # node 3 is next to node 8, which is held
HELD = ROD_STIFFNESS.copy()
HELD[0, 0] = 1e36
SCENE = """
[structure]
type = "matrices"
mass = "job_MASS1.mtx"
stiffness = "job_STIF1.mtx"
stiffness_damping = 1e-4
contact_dofs = {contact}
[contact]
law = "none"
[forcing]
frequency = 60.0
[[forcing.terms]]
kind = "base_acceleration"
amplitude = 30.0
{along}
[time]
trial = "fourier"
weight = "fourier"
functions = 7
[analysis]
type = "forced_response"
"""


def coordinates(matrix):
    return "".join(f"{i + 1:7}{j + 1:7} {matrix[i, j]:.15e}\n" for j in range(4) for i in range(j, 4) if matrix[i, j])


@pytest.mark.parametrize("labelled", [True, False])
def test_rows_that_are_held_do_not_move_and_take_their_masses_along_with_the_base(write, labelled):
    texts = [matrix_input(one, ROD_LABELS) if labelled else coordinates(one) for one in (HELD, ROD_MASS)]
    write("job_STIF1.mtx", texts[0]), write("job_MASS1.mtx", texts[1])
    place, along = ('["node 5 x"]', 'direction = "x"') if labelled else ("[4]", "dofs = [1, 2, 3, 4]")
    record = wb.run(SCENE.format(contact=place, along=along), {"analysis.stability": False})
    omega = 2.0 * np.pi * 60.0
    dynamic = (1.0 + 1e-4j * omega) * ROD_STIFFNESS - omega**2 * ROD_MASS
    expected = np.linalg.solve(dynamic[1:, 1:], -30.0 * ROD_MASS[1:].sum(axis=1))[2]
    assert record.summary["rms_displacement_m"] == pytest.approx(abs(expected) / np.sqrt(2.0), rel=1e-12)


def test_a_contact_on_a_row_that_is_held_is_refused_and_conversion_leaves_it_out(write):
    write("job_STIF1.mtx", matrix_input(HELD, ROD_LABELS)), write("job_MASS1.mtx", matrix_input(ROD_MASS, ROD_LABELS))
    with pytest.raises(wb.SceneError, match="degree of freedom 3 is held: structure.stiffness has 1e36 on its diagonal"):
        wb.check(SCENE.format(contact='["node 8 x"]', along='direction = "x"'))
    found = wb.read_matrices(["job_STIF1.mtx", "job_MASS1.mtx"])
    assert found.rows == ("node 3 x", "node 5 x", "node 12 x")
    order = [1, 3, 2]
    np.testing.assert_allclose(found.stiffness.toarray(), ROD_STIFFNESS[np.ix_(order, order)])
    np.testing.assert_allclose(found.mass.toarray(), ROD_MASS[np.ix_(order, order)])
