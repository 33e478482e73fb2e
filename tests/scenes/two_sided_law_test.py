"""A law that acts on both sides accepts no obstacle on either side."""

import pytest

SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
modal_damping = 0.01
[contact]
law = "linear"
stiffness = 10.0
gap = 1.0
[[contact.pairs]]
dofs = [1]
side = "both"
{pair}
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.2
[time]
trial = "fourier"
weight = "fourier"
functions = 63
[analysis]
type = "forced_response"
"""

TWO_SIDED = ['law = "clearance"', 'law = "cubic"\ncubic_stiffness = 1.0', 'law = "polynomial"\npolynomial = [0.0, 1.0]',
             'law = "bilinear"\nslopes = [1.0, 2.0]', 'law = "table"\ntable = "both.csv"']
ONE_SIDED = ["", 'law = "bilinear"\nslopes = [0.0, 2.0]', 'law = "table"\ntable = "one.csv"']


@pytest.fixture
def files(matrix, tmp_path):
    matrix("m.mtx", [[1.0]])
    (tmp_path / "both.csv").write_text("-1,-2\n0,0\n1,1\n")
    (tmp_path / "one.csv").write_text("-1,0\n0,0\n1,1\n")


@pytest.mark.parametrize("pair", TWO_SIDED)
def test_a_law_of_both_sides_refuses_side_both(run, files, pair):
    record = run(SCENE.format(pair=pair))
    assert record.code == 2
    assert 'contact.pairs[1].side = "both"' in record.errors
    assert 'expected "positive" or "negative"' in record.errors


@pytest.mark.parametrize("pair", ONE_SIDED)
def test_a_law_of_one_side_takes_it(run, files, pair):
    assert run(SCENE.format(pair=pair)).code == 0
