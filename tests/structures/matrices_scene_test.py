"""Structures of matrices as scenes: their files, contacts, loads and damping, and what is refused."""

import tomllib

import numpy as np
import pytest
from structure_scenes import BAR, CHAIN, MATRICES, changed, displacements, refused, solved

import wavebalance as wb

SYMMETRIC = "%%MatrixMarket matrix coordinate real symmetric\n"
GENERAL = "%%MatrixMarket matrix coordinate real general\n"
RIGID = changed(CHAIN, ('"linear"', '"rigid"'), ("stiffness = 1e7", "# "))
DAMPED = changed(CHAIN, ("modal_damping = 0.01 ", 'damping = "c.mtx"'))
VECTOR = changed(CHAIN, ("load_dofs = [3]", 'load = "f.mtx"'))


@pytest.fixture(autouse=True)
def chain(chain_files):
    return chain_files


def read(scene, overrides=None, unset=()):
    """The scene with its defaults, as a dictionary."""
    return tomllib.loads(wb.complete(scene, overrides, unset=unset))


@pytest.mark.parametrize("change, line, key, part", [
    (("modal_damping = 0.01", "modal_damping = 2"), 6, "structure.modal_damping", "in 0..1"),
    (('"k.mtx"', '"m.mtx"'), 4, "structure.stiffness", "is the file of structure.mass, too"),
    (("[2, 3]", "[3, -3]"), 5, "structure.contact_dofs",
     '[[contact.pairs]] with dofs = [3] and side = "both" has an obstacle on either side'),
    (("[2, 3]", "[2, 4]"), 5, "structure.contact_dofs", "no degree of freedom 4"),
    (("[2, 3]", "[0]"), 5, "structure.contact_dofs", "expected 1..3"),
    (("[2, 3]", "[3, -3]"), 5, "structure.contact_dofs", "3 is there twice"),
    (("[2, 3]", "[]"), 5, "structure.contact_dofs", "there are 0"),
    (("[2, 3]", "[2.5]"), 5, "structure.contact_dofs", "a list of integers"),
    (("[2, 3]", "3"), 5, "structure.contact_dofs", "a list of integers"),
    (("contact_dofs", "# "), 1, "structure.contact_dofs", "missing"),
    (("gap = 1e-4", "gap = [1, 2, 3]"), 10, "contact.gap", "each of 2 degrees"),
    (("gap = 1e-4", "gap = [1, inf]"), 10, "contact.gap", "finite"),
    (("gap = 1e-4", 'gap = ["a"]'), 10, "contact.gap", "or a list of them"),
    (("[contact]", "stiffness_damping = 1e-5\n[contact]"), 6, "structure.modal_damping", "another damping"),
    (("[contact]", 'damping = "k.mtx"\n[contact]'), 7, "structure.damping", "another damping"),
    (("modal_damping = 0.01 ", "elements = 3 "), 6, "structure.elements",
     'structure.type = "matrices"; only with structure.type = "bar"'),
    (("modal_damping = 0.01 ", "chord = [1, 2] "), 6, "structure.chord", 'only with structure.type = "blade"'),
    (("load_dofs = [3]", ""), 11, "forcing.load", "missing; expected load"),
    (("load_dofs = [3]", "load_dofs = [-5]"), 12, "forcing.load_dofs", "no degree of freedom -5"),
    (("m.mtx", "no.mtx"), 3, "structure.mass", "no.mtx: the file cannot be opened"),
    (('"m.mtx"', "3"), 3, "structure.mass", "the name of a file"),
    (("m.mtx", "/dev/zero"), 3, "structure.mass", "/dev/zero is not a regular file"),
])
def test_a_wrong_value_is_refused_at_its_line(change, line, key, part):
    refused(changed(CHAIN, change), key, part, line=line)


@pytest.mark.parametrize("text, change, line, key, parts", [
    (SYMMETRIC + "3 3 1\n4 1 2\n", ("k.mtx", "x.mtx"), 4, "structure.stiffness",
     ["x.mtx:3: the row is 4; it must be in 1..3"]),
    (SYMMETRIC + "2 2 2\n1 1 1\n2 2 1\n", ("m.mtx", "x.mtx"), 3, "structure.mass", ["2 x 2; expected 3 x 3"]),
    (GENERAL + "2 3 1\n1 1 1\n", ("k.mtx", "x.mtx"), 4, "structure.stiffness", ["2 x 3; expected a square"]),
    (SYMMETRIC + "2 2 2\n1 1 1\n2 2 1\n", ("modal_damping = 0.01 ", 'damping = "x.mtx" '), 6, "structure.damping",
     ["2 x 2; expected 3 x 3"]),
    (GENERAL + "3 3 4\n1 1 2\n2 2 2\n3 3 2\n1 3 1\n", ("k.mtx", "x.mtx"), 4, "structure.stiffness",
     ["is not symmetric: row 3, column 1"]),
    (SYMMETRIC + "3 3 2\n1 1 2\n3 3 2\n", ("m.mtx", "x.mtx"), 5, "structure.contact_dofs",
     ["degree of freedom 2 has no mass and is condensed"]),
    (SYMMETRIC + "3 3 5\n1 1 1\n2 1 -1\n2 2 2\n3 2 -1\n3 3 1\n", ("k.mtx", "x.mtx"), 4, "structure.stiffness",
     ["free to move"]),
    ("%%MatrixMarket matrix array real general\n2 1\n0\n1\n", ("load_dofs = [3]", 'load = "x.mtx"'), 12, "forcing.load",
     ["2 entries; expected 3", "{folder}/x.mtx", "{folder}/k.mtx"]),
    ("", ("load_dofs = [3]", 'load = "k.mtx"'), 12, "forcing.load", ["the file holds a matrix; expected a vector: one column"]),
    ("", ("load_dofs = [3] ", 'load = "f.mtx"\nload_dofs = [1] '), 13, "forcing.load_dofs", ["not both"]),
])
def test_a_wrong_file_is_refused_at_its_line(chain, text, change, line, key, parts):
    (chain / "x.mtx").write_text(text)
    refused(changed(CHAIN, change), key, *(part.format(folder=chain) for part in parts), line=line)


def test_rows_without_mass_are_named_where_they_are_not_condensed(chain):
    (chain / "x.mtx").write_text(SYMMETRIC + "3 3 2\n1 1 2\n3 3 2\n")
    refused(changed(CHAIN, ("m.mtx", "x.mtx"), ("[2, 3]", "[3]\nunsymmetric = true")), "structure.mass",
            "not positive definite: its diagonal entry 2 is 0",
            "1 row has no mass: 2. They are condensed statically if", line=3)


def test_keys_of_matrices_and_gaps_of_several_contacts_belong_to_no_bar():
    refused(changed(BAR, ("[contact]", "contact_dofs = [1]\n[contact]")), "structure.contact_dofs",
            'only with structure.type = "matrices"', line=9)
    refused(changed(BAR, ("gap = 1e-3", "gap = [1e-3, 2e-3]")), "contact.gap", "each of 1 degree of freedom")


def test_obstacles_on_both_sides_with_a_gap_that_presses_are_described_and_warned_of():
    both = changed(CHAIN, ("contact_dofs = [2, 3]", "# "),
                   ("[forcing]", '[[contact.pairs]]\ndofs = [3]\nside = "both"\ngap = -1e-4\n[forcing]'))
    assert " µm; two contacts for each of the 1 direction with obstacles on both sides" in wb.check(both)
    warnings = wb.run(both).warnings
    assert any(one.startswith('contact.pairs[1].gap is -100 µm with side = "both"') for one in warnings), warnings


def test_time_stepping_counts_the_states_of_the_matrices():
    assert "size       6 states" in wb.check(CHAIN, {"analysis.type": "time_stepping"})


def test_time_stepping_of_many_modes_is_advised_to_keep_fewer():
    def described(**more):
        overrides = {"analysis.type": "time_stepping", **{f"structure.{key}": value for key, value in more.items()}}
        return wb.check(MATRICES / "strip_forced.toml", overrides, unset=["analysis.motion_points"])

    assert "advice     time stepping follows all 72 modes" in described()
    assert "advice" not in described(kept_modes=4)


def test_damping_that_adds_energy_is_a_warning(matrix):
    matrix("c.mtx", [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, -1.0]])
    assert "warning    structure.damping is not positive semidefinite" in wb.check(DAMPED)
    (warning,) = wb.run(DAMPED).warnings
    assert "the structure itself is unstable" in warning
    matrix("c.mtx", [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 1.0]])
    assert wb.run(DAMPED).warnings == []


def test_paths_are_relative_to_the_file_of_the_scene(chain, monkeypatch, tmp_path_factory):
    (chain / "case.toml").write_text(CHAIN)
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    scene = read(chain / "case.toml")
    assert scene["structure"]["mass"] == f"{chain}/m.mtx"
    assert scene["structure"]["contact_dofs"] == [2, 3]
    assert scene["structure"].get("kept_modes", -1) == -1
    assert scene["analysis"].get("motion_points", 0) == 0
    said = wb.check(chain / "case.toml")
    assert "matrices, 3 degrees of freedom\n" in said and "reduced" not in said
    written = wb.complete(chain / "case.toml")
    assert wb.complete(written) == written and wb.check(written) == said


def test_dense_matrices_and_a_sparse_load_are_taken_as_the_others_are(chain):
    dense = "%%MatrixMarket matrix array real "
    (chain / "k_dense.mtx").write_text(dense + "general\n3 3\n2e6\n-1e6\n0\n-1e6\n2e6\n-1e6\n0\n-1e6\n1e6\n")
    (chain / "m_dense.mtx").write_text(dense + "symmetric\n3 3\n2\n0\n0\n2\n0\n2\n")
    (chain / "f_dense.mtx").write_text(dense + "general\n3 1\n0\n0\n1\n")
    (chain / "f.mtx").write_text(GENERAL + "3 1 1\n3 1 1\n")
    others = changed(VECTOR, ("k.mtx", "k_dense.mtx"), ("m.mtx", "m_dense.mtx"), ("f.mtx", "f_dense.mtx"))
    expected = displacements(solved(VECTOR))
    np.testing.assert_array_equal(displacements(solved(others)), expected)
    np.testing.assert_array_equal(displacements(solved(CHAIN)), expected)


def test_gaps_are_one_or_one_a_contact():
    two = changed(CHAIN, ("gap = 1e-4", "gap = [1e-4, 2e-4]"))
    assert read(two)["contact"]["gap"] == [1e-4, 2e-4]
    written = wb.complete(two)
    assert wb.complete(written) == written
    rest = '[[forcing.terms]]\nharmonic = 0\namplitude = 1.0\n'
    gaps = [wb.run(scene + rest).summary["at_rest"]["gap_m"].tolist()
            for scene in (two, changed(CHAIN, ("gap = 1e-4", "gap = 1")))]
    assert gaps == [[1e-4, 2e-4], [1.0, 1.0]]
    assert read(changed(CHAIN, ("gap = 1e-4", "gap = 1")))["contact"]["gap"] == 1.0


@pytest.mark.parametrize("kept, size", [(1, 3), (0, 2)])
def test_reductions_keep_the_contacts_and_so_many_modes(kept, size):
    assert solved(CHAIN, {"structure.kept_modes": kept}).summary["reduced_degrees_of_freedom"] == size


def test_reductions_keep_no_more_modes_than_there_are():
    refused(CHAIN, "structure.kept_modes", "at most 1", overrides={"structure.kept_modes": 2})
    refused(CHAIN, "structure.kept_modes", overrides={"structure.kept_modes": 0, "structure.contact_dofs": [1, 2, 3]})


@pytest.mark.parametrize("overrides, unset, key", [
    ({}, [], "structure.modal_damping"),
    ({"contact.gap": [1e-4, 0.0]}, ["structure.modal_damping"], "contact.gap"),
    ({"analysis.mode": 4}, ["structure.modal_damping"], "analysis.mode"),
    ({"structure.damping": "k.mtx"}, ["structure.modal_damping"], "structure.damping"),
])
def test_nonlinear_modes_are_without_damping_and_with_positive_gaps(overrides, unset, key):
    refused(RIGID, key, overrides={"analysis.type": "nonlinear_mode", **overrides}, unset=unset)
    accepted = read(RIGID, {"analysis.type": "nonlinear_mode"}, ["structure.modal_damping"])
    assert accepted["analysis"]["samples"] == 20


@pytest.mark.parametrize("part", ["matrices, 3 degrees of freedom", "reduced to 3 (1 mode)", "at 2 degrees of freedom",
                                  "64 unknowns", "on 1 degree of freedom"])
def test_check_says_how_large_it_is(part):
    assert part in wb.check(CHAIN, {"structure.kept_modes": 1})
