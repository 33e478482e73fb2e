"""Names of degrees of freedom, files of other formats than Matrix Market, and the output of check for matrices."""

import tomllib

import numpy as np
import pytest
from structure_scenes import CHAIN, CHAIN_MASS, CHAIN_STIFFNESS, changed, displacements, modal_damping, refused, solved

import wavebalance as wb

NAMED = changed(CHAIN, ("[2, 3] ", '["node 20 x", "-node 4 ry"]'), ("load_dofs = [3]", 'load_dofs = ["node 4 ry"]'),
                ("modal_damping = 0.01 ", 'modal_damping = 0.01\ndof_map = "chain.dof" '))
PAIRS = changed(NAMED, ("contact_dofs", "# "),
                ("[forcing]", '[[contact.pairs]]\ndofs = ["node 20 x", "node 7 x"]\n[forcing]'))
OMEGA = 2.0 * np.sqrt(1e6 / 2.0) * np.sin((2 * np.arange(1, 4) - 1) * np.pi / 14.0)  # of the chain, closed form
EXACT = 1e-12


@pytest.fixture(autouse=True)
def named_chain(chain_files):
    (chain_files / "chain.dof").write_text("7.1\n20.1\n4.5\n")
    return chain_files


def rows(overrides=None, scene=NAMED):
    return tomllib.loads(wb.complete(scene, overrides))["structure"]["contact_dofs"]


def test_names_are_the_rows_that_the_map_gives_them(named_chain):
    assert rows() == [2, -3]
    assert tomllib.loads(wb.complete(NAMED))["forcing"]["load_dofs"] == [3]
    assert rows(['structure.contact_dofs=[1, "node 20 1", "-node 4 ROTY"]']) == [1, 2, -3]
    (named_chain / "chain.csv").write_text("row,node,direction\n3,4,ry\n1,7,x\n2,20,x\n")
    assert rows({"structure.dof_map": "chain.csv"}) == [2, -3]


def test_pairs_take_names_and_are_read_back_as_written():
    written = wb.complete(PAIRS)
    assert [one["dofs"] for one in tomllib.loads(written)["contact"]["pairs"]] == [[2, 1]]
    assert wb.complete(written) == written
    refused(changed(PAIRS, ('"node 7 x"', '"-node 7 x"')), "contact.pairs[1].dofs",
            "expected no sign here; coefficients has the signs", line=13)


@pytest.mark.parametrize("name, allowed", [
    ('"nod 20 x"', '"nod 20 x" is no degree of freedom'),
    ('"node 20 w"', "a direction of x, y, z, rx, ry, rz"),
    ('"node 20 x 3"', "is no degree of freedom"),
    ('"node 20 y"', "expected one of x"),
    ('"node 21 x"', "node 21 is not in {folder}/chain.dof"),
    ("2.5", "expected a list of integers or texts"),
    ('"node 4 ry"', "degree of freedom 3 is there twice"),
])
def test_a_wrong_name_is_refused_with_what_is_allowed(named_chain, name, allowed):
    scene = changed(NAMED, ('"node 20 x"', name))
    refused(scene, "structure.contact_dofs", allowed.format(folder=named_chain), line=5)


def test_names_need_a_map_and_are_no_gaps():
    refused(changed(NAMED, ("dof_map", "# ")), "structure.contact_dofs", "the scene has no structure.dof_map", line=5)
    refused(changed(NAMED, ("gap = 1e-4", 'gap = ["node 20 x"]')), "contact.gap", "or a list of them", line=11)


@pytest.mark.parametrize("text, parts", [
    ("7.1\n20.1\n4.5\n4.6\n", ["{folder}/chain.dof names 4 rows; expected 3", "{folder}/k.mtx"]),
    ("7.1\n20.9\n", ['chain.dof:2: the direction is "9"']),
    (None, ["cannot be opened"]),
])
def test_a_wrong_map_is_refused_with_its_file_and_that_of_the_matrices(named_chain, text, parts):
    (named_chain / "chain.dof").unlink() if text is None else (named_chain / "chain.dof").write_text(text)
    refused(NAMED, "structure.dof_map", *(part.format(folder=named_chain) for part in parts), line=7)


K_RSA = """chain
 4 1 1 2 0
RSA 3 3 5 0
(4I3) (5I2) (1P,3D12.4)
  1  3  5  6
 1 2 2 3 3
  2.0000D+06 -1.0000D+06  2.0000D+06
 -1.0000D+06  1.0000D+06
"""


def test_files_of_calculix_and_of_harwell_and_boeing_give_the_same_motion(named_chain):
    (named_chain / "k.sti").write_text("1 1  2.e6\n1 2 -1.e6\n2 2  2.e6\n2 3 -1.e6\n3 3  1.e6\n")
    (named_chain / "m.mas").write_text("1 1 2.\n1 2 0.0\n2 2 2.\n3 3 2.\n")
    (named_chain / "k.rsa").write_text(K_RSA)
    expected = displacements(solved(NAMED))
    for stiffness in ("k.sti", "k.rsa"):
        found = displacements(solved(NAMED, {"structure.stiffness": stiffness, "structure.mass": "m.mas"}))
        np.testing.assert_array_equal(found, expected)


def test_matrices_of_different_sizes_are_refused_with_both_files(named_chain):
    (named_chain / "m.mas").write_text("1 1 2.\n2 2 2.\n")
    refused(NAMED, "structure.mass", f"{named_chain}/m.mas is 2 x 2; expected 3 x 3",
            f"structure.stiffness in {named_chain}/k.mtx", overrides={"structure.mass": "m.mas"})


@pytest.mark.parametrize("mode", [1, 2, 3])
def test_the_modes_have_the_frequencies_of_the_closed_form(mode):
    scene = changed(NAMED, ("modal_damping = 0.01", "# "), ('"linear"', '"rigid"'), ("stiffness = 1e7", "# "))
    record = wb.run(scene, {"analysis.type": "nonlinear_mode", "analysis.mode": mode, "analysis.points": 2,
                            "analysis.last_frequency_ratio": 1.01})
    assert record.summary["linear_frequency_Hz"] == pytest.approx(OMEGA[mode - 1] / (2.0 * np.pi), rel=EXACT)


def test_contacts_yield_as_their_compliances_of_the_closed_form(matrix):
    for row, compliance in ((2, 2e-6), (3, 3e-6)):
        matrix("unit.mtx", [[float(i == row)] for i in (1, 2, 3)])
        rest = wb.run(changed(CHAIN, ("load_dofs = [3]", ""), ("amplitude = 100.0", ""), ("gap = 1e-4", "gap = 1.0"))
                      + '[[forcing.terms]]\nharmonic = 0\namplitude = 1.0\nload = "unit.mtx"\n'
                      + "[[forcing.terms]]\namplitude = 1.0\ndofs = [1]\n").summary["at_rest"]
        assert rest["displacement_m"][row - 2] == pytest.approx(compliance, rel=EXACT, abs=0.0)


@pytest.mark.parametrize("overrides, damping, said", [
    ({"structure.modal_damping": 0.01}, modal_damping(CHAIN_STIFFNESS, CHAIN_MASS, 0.01), [0.01] * 3),
    ({"structure.damping": "c.mtx"}, 40.0 * np.eye(3), 40.0 / 2.0 / (2.0 * OMEGA)),
    ({"structure.stiffness_damping": 1e-5}, 1e-5 * CHAIN_STIFFNESS, 0.5e-5 * OMEGA),
])
def test_every_damping_is_that_of_the_closed_form(matrix, overrides, damping, said):
    matrix("c.mtx", (40.0 * np.eye(3)).tolist())
    scene = changed(CHAIN, ("modal_damping = 0.01", "# "))
    linear = {**overrides, "contact.law": "none"}, ["contact.stiffness", "contact.gap"]
    omega = 2.0 * np.pi * 50.0
    exact = np.linalg.solve(CHAIN_STIFFNESS - omega**2 * CHAIN_MASS + 1j * omega * damping, [0.0, 0.0, 100.0])[1:]
    record = solved(scene, *linear)
    harmonic = wb.harmonics_of(displacements(record), 1)[:, 1]
    np.testing.assert_allclose(harmonic, exact, rtol=EXACT)
    ratios = ", ".join(f"{one:.5g}" for one in said) if len(set(said)) > 1 else "0.01 each"
    assert "damping ratio" in wb.check(scene, overrides) and ratios in wb.check(scene, overrides)


MANY_PAIRS = "".join(f"[[contact.pairs]]\ndofs = {dofs}\n" for dofs in ("[1]", "[2]", "[3]", "[2, 1]", "[3, 1]"))


@pytest.mark.parametrize("scene, part", [
    (NAMED, "modes      50.085, 140.33, 202.79 Hz, damping ratios 0.01 each\n"),
    (NAMED, "compliance 2 µm/N at node 20 x; 3 µm/N at -node 4 ry\n"),
    (CHAIN, "compliance 2 µm/N at row 2; 3 µm/N at row 3\n"),
    (changed(NAMED, ("modal_damping = 0.01", "# ")), "Hz, without damping\n"),
    (changed(NAMED, ("contact_dofs", "# "), ("[forcing]", MANY_PAIRS + "[forcing]")),
     "compliance from 1 µm/N at node 7 x to 3 µm/N at node 4 ry\n"),
], ids=["modes", "compliances", "rows", "undamped", "many pairs"])
def test_check_describes_the_structure_with_the_names_of_its_contacts(scene, part):
    assert part in wb.check(scene)


@pytest.mark.parametrize("name, row", [("-node 2 z #2", -3), ("node 2 z #1", 1)])
def test_rows_of_one_name_are_numbered_in_their_order(named_chain, name, row):
    (named_chain / "chain.dof").write_text("2.3\n7.3\n2.3\n")
    scene = changed(NAMED, ('["node 20 x", "-node 4 ry"]', f'["{name}"]'), ('"node 4 ry"', "3"))
    assert rows(scene=scene) == [row]
    assert f"at {name}\n" in wb.check(scene)


@pytest.mark.parametrize("name, allowed", [
    ("node 2 z", 'expected one of "node 2 z #1" (row 1), "node 2 z #2" (row 3)'),
    ("node 2 z #3", "there are 2 rows of that name"),
    ("node 2 z #0", "is no degree of freedom"),
    ("node 2 z 2", "is no degree of freedom"),
])
def test_rows_of_one_name_are_refused_without_their_number(named_chain, name, allowed):
    (named_chain / "chain.dof").write_text("2.3\n7.3\n2.3\n")
    scene = changed(NAMED, ('["node 20 x", "-node 4 ry"]', f'["{name}"]'), ('"node 4 ry"', "3"))
    refused(scene, "structure.contact_dofs", allowed)
