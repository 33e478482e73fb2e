"""Matrices of Nastran: DMIG in bulk data and OUTPUT4, each against the matrix that was written."""

import numpy as np
import pytest
from code_files import (
    ascending,
    dmig,
    dmig_loads,
    free,
    header,
    large,
    output4_binary,
    output4_text,
    random_structure,
    small,
)

import wavebalance as wb

MASS, DAMPING, STIFFNESS, LABELS = random_structure()
LOADS = np.c_[np.arange(1.0, 10.0), np.zeros(9)]
LOADS[3, 1] = -2.5
DIGITS = {"rtol": 1e-9, "atol": 0.0}


@pytest.fixture
def read(tmp_path):
    """Matrices of one file with these contents."""

    def read(content, place="", name="job.dat"):
        file = tmp_path / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return wb.read_matrices(f"{file}{place}")

    return read


def dense(found):
    return None if found is None else found.toarray()


JOB = ("$TITLE   = CHAIN\nBEGIN BULK\nGRID    7               0.0     1.0     2.0\n"
       + dmig("KAAX", STIFFNESS, LABELS) + small("ASET1", 123, 7) + "*       123\n"
       + dmig("MAAX", MASS, LABELS, triangle=np.tril) + dmig("BAAX", DAMPING, LABELS, form=1)
       + dmig_loads("PAX", LOADS, LABELS) + "ENDDATA\nDMIG\n")


def test_bulk_data_give_all_matrices_with_the_names_of_their_nodes(read):
    found = read(JOB)
    np.testing.assert_allclose(dense(found.stiffness), ascending(STIFFNESS, LABELS), **DIGITS)
    np.testing.assert_allclose(dense(found.mass), ascending(MASS, LABELS), **DIGITS)
    np.testing.assert_allclose(dense(found.damping), ascending(DAMPING, LABELS), **DIGITS)
    np.testing.assert_allclose(found.load, np.c_[ascending(LOADS[:, 0], LABELS), ascending(LOADS[:, 1], LABELS)], **DIGITS)
    expected = sorted(LABELS)
    assert list(zip(found.nodes, found.directions, strict=True)) == [(node, {1: "x", 2: "y", 6: "rz"}[c]) for node, c in expected]
    assert found.row(f"node {expected[4][0]} y") == 4


@pytest.mark.parametrize("write, digits", [(small, 0.06), (large, 1e-9), (free, 1e-7)])
@pytest.mark.parametrize("form", [1, 6])
def test_fields_may_be_small_large_or_free(read, write, digits, form):
    found = read(dmig("K2GG", STIFFNESS, LABELS, form=form, write=write)).stiffness
    np.testing.assert_allclose(dense(found), ascending(STIFFNESS, LABELS), rtol=digits)


def test_a_component_of_zero_is_a_scalar_point_and_a_real_may_have_no_letter(read):
    text = (header("KAAX", 6, 1) + small("DMIG", "KAAX", 101, 0, "", 101, 0, "1.5+3") + small("DMIG", "KAAX", 7, 3, "", 7, 3, "2.-1")
            + "+       101             -1.D-2\n")
    found = read(text)
    assert found.rows == ("node 7 z", "node 101 scalar")
    assert dense(found.stiffness).tolist() == [[0.2, -0.01], [-0.01, 1500.0]]


def test_one_of_several_matrices_is_named_behind_the_file(read):
    assert list(read(JOB, "#maax").matrices) == ["mass"]
    with pytest.raises(ValueError, match='no matrices of the name "KXX"; the file holds KAAX, MAAX, BAAX, PAX'):
        read(JOB, "#KXX")


ENTRY = small("DMIG", "KAAX", 2, 1, "", 2, 1, "2.0+3")
WRONG = {
    "no header": (ENTRY, "job.pch:1: a column of KAAX comes before the header of that matrix"),
    "two headers": (header("KAAX", 6, 2) * 2, "job.pch:2: KAAX has a second header"),
    "form": (header("KAAX", 3, 2), "the form of KAAX is 3; it must be 1 (square), 6 (symmetric), 2 or 9 (rectangular)"),
    "complex": (header("KAAX", 6, 4), "job.pch:1: the type of KAAX is 4, complex; it must be 1 or 2, real"),
    "imaginary": (header("KAAX", 6, 2) + small("DMIG", "KAAX", 2, 1, "", 2, 1, "2.0", "1.0"),
                  "job.pch:2: a value of KAAX has the imaginary part 1.0; it must be real"),
    "value": (header("KAAX", 6, 2) + small("DMIG", "KAAX", 2, 1, "", 2, 1, "two"), 'a value of KAAX is "two"'),
    "no value": (header("KAAX", 6, 2) + small("DMIG", "KAAX", 2, 1, "", 2, 1), 'a value of KAAX is ""'),
    "grid": (header("KAAX", 6, 2) + small("DMIG", "KAAX", 2, 1, "", "", 1, "2.0"), "the grid point is missing"),
    "component": (header("KAAX", 6, 2) + small("DMIG", "KAAX", 2, 7, "", 2, 1, "2.0"),
                  "the component is 7; it must be in 0..6"),
    "twice": (header("KAAX", 6, 2) + 2 * ENTRY,
              "the entry (node 2 x, node 2 x) of KAAX is given twice, as 2000 and 2000"),
    "triangles": (header("KAAX", 6, 2) + ENTRY + small("DMIG", "KAAX", 3, 1, "", 2, 1, "-1.0", "", 3, 1, "4.0")
                  + small("DMIG", "KAAX", 2, 1, "", 3, 1, "-1.5"),
                  "the entry (node 3 x, node 2 x) of KAAX is -1.5 and (node 2 x, node 3 x) of KAAX is -1; a symmetric file"),
    "nothing": ("GRID    7\n", "there is no DMIG entry"),
}


@pytest.mark.parametrize("text, expected", WRONG.values(), ids=WRONG)
def test_what_is_wrong_with_bulk_data_is_named(read, text, expected):
    with pytest.raises(ValueError) as raised:
        read(text, name="job.pch")
    assert expected in str(raised.value)
    assert "; the file was read as DMIG of Nastran" in str(raised.value)


LAYOUTS = ["dense", "sparse", "bigmat"]


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("kind", [1, 2])
def test_output4_in_text_gives_its_matrices(read, layout, kind):
    loads = np.delete(LOADS, 4, axis=0).T  # rows that are no square
    text = "".join(output4_text(name, matrix, layout, form, kind) for name, matrix, form in (
        ("KAA", STIFFNESS, 6), ("MAA", MASS, 6), ("BAA", DAMPING, 1), ("PA", loads, 2)))
    found = read(text)
    for expected, matrix in ((STIFFNESS, found.stiffness), (MASS, found.mass), (DAMPING, found.damping)):
        np.testing.assert_allclose(dense(matrix), expected, rtol=1e-15)
    np.testing.assert_array_equal(found.load, loads)
    assert found.rows is None


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("kind, word", [(1, 4), (2, 4), (2, 8)])
@pytest.mark.parametrize("order", "<>")
def test_output4_in_binary_gives_its_matrices(read, layout, kind, word, order):
    data = b"".join(output4_binary(name, matrix, layout, 6, kind, order, word) for name, matrix in (
        ("KAA", STIFFNESS), ("MAA", MASS)))
    found = read(data)
    digits = 1e-7 if kind == 1 else 0.0
    np.testing.assert_allclose(dense(found.stiffness), STIFFNESS, rtol=digits)
    np.testing.assert_allclose(dense(found.mass), MASS, rtol=digits)
    assert list(read(data, "#maa").matrices) == ["mass"]


def test_a_symmetric_matrix_of_output4_may_hold_one_triangle(read):
    found = read(output4_text("KAA", np.tril(STIFFNESS)))
    np.testing.assert_allclose(dense(found.stiffness), STIFFNESS, rtol=1e-15)


TEXT = output4_text("KAA", STIFFNESS, "bigmat")
OUTPUT4 = {
    "truncated": ("\n".join(TEXT.split("\n")[:8]), "kaa.op4:8: the file ends"),
    "no end": (TEXT[:TEXT.rindex("      10")], "the file ends before number, first row and words of a column"),
    "complex": (TEXT.replace("       2KAA", "       4KAA", 1), "kaa.op4:1: the type of KAA is 4, complex; it must be 1 or 2, real"),
    "form": (TEXT.replace("       6       2KAA", "       3       2KAA", 1), "the form of KAA is 3; it must be 1 (square)"),
    "format": (TEXT.replace("1P,3E23.16", "whatever", 1), 'kaa.op4:1: the format is "whatever"; it must be one of Fortran'),
    "rows": (TEXT.replace("      -9", "      -5", 1), "kaa.op4:1: KAA is 5 x 9; the form 6 must be square"),
    "string": (output4_text("KAA", STIFFNESS, "sparse").replace("       1       0", "       1       0      -1\n#", 1),
               "kaa.op4:3"),
    "value": (TEXT.replace("E+0", "X+0", 1), 'it must be a finite number in a field of 23 characters'),
    "column": (TEXT.replace("       2       0", "       1       0", 1), "a column of KAA is 1; it must be in 2..10"),
    "triangles": (output4_text("KAA", STIFFNESS + np.eye(9, k=1), "dense"), "of KAA is "),
}


@pytest.mark.parametrize("text, expected", OUTPUT4.values(), ids=OUTPUT4)
def test_what_is_wrong_with_output4_in_text_is_named_with_its_line(read, text, expected):
    with pytest.raises(ValueError) as raised:
        read(text, name="kaa.op4")
    assert expected in str(raised.value)
    assert "; the file was read as OUTPUT4 of Nastran" in str(raised.value)


DATA = output4_binary("KAA", STIFFNESS)
BINARY = {
    "truncated": (DATA[:100], "kaa.op4: record 2: the file ends within this record"),
    "no end": (DATA[:-28], "the file ends before this record"),
    "marker": (DATA[:32] + DATA[32:36] + DATA[36:-4] + b"\1\0\0\0", "its length is 20 before it and 1 after it; they must agree"),
    "words": (DATA[:44] + b"\1\0\0\0" + DATA[48:], "record 2: a column says that it has 1 words; its record has"),
    "row": (DATA[:40] + b"\7\0\0\0" + DATA[44:], "the last row in column 1 of KAA is 15; it must be in 1..9"),
    "complex": (output4_binary("KAA", STIFFNESS, kind=4), "record 1: the type of KAA is 4, complex"),
}


@pytest.mark.parametrize("data, expected", BINARY.values(), ids=BINARY)
def test_what_is_wrong_with_output4_in_binary_is_named_with_its_record(read, data, expected):
    with pytest.raises(ValueError) as raised:
        read(data, name="kaa.op4")
    assert expected in str(raised.value)
