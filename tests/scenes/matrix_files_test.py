"""Files of matrices are known by their content, and what is not read is named."""

import pytest

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
    """The record of the scene with its matrices in these texts, under names that say nothing."""

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
    assert named > 2.0 * scaled  # 5 N in place of 1 N


@pytest.mark.parametrize("text, named", [
    ("2,1, 2,1, 2e3\n3,1, 2,1, -1e3\n", "matrix input of Abaqus"),
    ("$TITLE = CHAIN\nDMIG    KAAX           0       6       2       0\n", "DMIG entries of Nastran"),
    ("       2       2       6       2KAA     1P,3E23.16\n", "OUTPUT4 of Nastran"),
    ("1 1 2e3\n1 2 -1e3\n2 1 -2e3\n", "the entry (2, 1) is -2000 and (1, 2) is -1000"),
    ("%%MatrixMarket matrix coordinate real symmetric\n2 2\n", "the file was read as Matrix Market"),
    ("no matrix\n", "the file was read as Matrix Market because of its name"),
])
def test_a_file_that_is_not_read_is_named_with_its_format(solved, text, named):
    record = solved(text)
    assert record.code == 2
    assert "structure.stiffness" in record.errors and named in record.errors
    assert not record.folder.exists()
