"""[[contact.pairs]]: directions of contact with their own laws."""

import numpy as np
import pytest

import wavebalance as wb

# The chain with relative motion, both sides of one mass, and a weighted sum with a separate law.
PAIRS = """[structure]
type = "matrices"               # 2
mass = "m.mtx"                  # 3
stiffness = "k.mtx"             # 4
modal_damping = 0.1             # 5
[contact]
law = "linear"                  # 7
stiffness = 1e6                 # 8
gap = 2e-5                      # 9
[[contact.pairs]]               # 10
dofs = [3, 1]                   # 11
[[contact.pairs]]               # 12
dofs = [2]                      # 13
side = "both"                   # 14
gap = 5e-5                      # 15
[[contact.pairs]]               # 16
dofs = [1, 2, 3]                # 17
coefficients = [0.5, -1, 2.0]   # 18
side = "negative"               # 19
law = "exponential"             # 20
constant = 1e4                  # 21
exponent = 100.0                # 22
[forcing]
load_dofs = [3]                 # 24
amplitude = 100.0               # 25
frequency = 35.0                # 26
[time]
trial = "fourier"
weight = "fourier"
functions = 63
[analysis]
type = "forced_response"        # 32
"""
DIRECTIONS = np.array([[-1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [-0.5, 1.0, -2.0]])
GAPS = [2e-5, 5e-5, 5e-5, 2e-5]
COEFFICIENTS = "[0.5, -1, 2.0]"
OWN_GAPS = (("gap = 2e-5  ", "#"), ("dofs = [3, 1]", "gap = 1e-5\ndofs = [3, 1]"))


@pytest.fixture
def pairs(chain_text):
    """The text of the scene, with the files of its matrices."""
    return PAIRS


def law_of(changed, text, law):
    """The scene with one law of all contacts, without keys that it does not have."""
    text = changed(text, ('"linear"                  # 7', f'"{law}"'), ("stiffness = 1e6", "# "),
                   ('law = "exponential"', "# "), ("constant = 1e4", "# "), ("exponent = 100.0", "# "))
    return changed(text, ("gap = 2e-5", "# "), ("gap = 5e-5", "# ")) if law == "none" else text


def contact_of(record, name):
    """A column of the contacts, contacts x times."""
    rows = [np.array(record.contacts["contact"]) == contact for contact in np.unique(record.contacts["contact"])]
    return np.array([record.contacts[name][row] for row in rows])


def test_pairs_are_directions_with_their_own_laws_and_gaps(solved, pairs):
    record = solved(pairs, {"analysis.outputs": [1, 2, 3]})
    assert record.converged
    dofs = [values for name, values in record.outputs.items() if name != "time_fraction"]
    u, force = contact_of(record, "displacement_m"), contact_of(record, "contact_force_N")
    np.testing.assert_allclose(u, DIRECTIONS @ dofs, rtol=0.0, atol=4e-15 * np.abs(u).max())
    beyond = np.maximum(u - np.array(GAPS)[:, None], 0.0)
    expected = 1e6 * beyond
    expected[3] = 1e4 * np.expm1(100.0 * beyond[3])
    assert np.all(expected.max(axis=1) > 0.0)
    np.testing.assert_allclose(force, expected, rtol=1e-12, atol=1e-12 * expected.max())
    assert record.contacts["contact"].max() == 4


@pytest.mark.parametrize("law", ["linear", "rigid", "none"])
def test_pairs_are_written_and_read_back_equal(pairs, changed, scene_file, written_equal, tmp_path, law):
    scene_file(pairs if law == "linear" else law_of(changed, pairs, law))
    written_equal(tmp_path / "case.toml")


def test_pairs_are_completed_with_the_law_of_all_or_their_own(completed, pairs):
    relative, both, weighted = completed(pairs)["contact"]["pairs"]
    assert relative["coefficients"] == [1.0, -1.0] and both["side"] == "both" and both["coefficients"] == [1.0]
    assert (relative["gap"], both["gap"], weighted["gap"]) == (2e-5, 5e-5, 2e-5)
    assert relative["law"] == both["law"] == "linear" and relative["stiffness"] == both["stiffness"] == 1e6
    assert weighted["law"] == "exponential" and "stiffness" not in weighted


def test_overrides_are_by_numbers_from_one(solved, completed, refusal, pairs):
    overrides = ["contact.pairs[2].side=positive", "contact.pairs[1].gap=3e-5"]
    gaps = [one["gap"] for one in completed(pairs, overrides, ["contact.pairs[2].gap"])["contact"]["pairs"]]
    assert gaps == [3e-5, 2e-5, 2e-5]
    assert solved(pairs, overrides, ["contact.pairs[2].gap"]).summary["contacts"] == 3
    missing = refusal(pairs, ["contact.pairs[4].gap=1e-5"])
    assert missing.key == "contact.pairs[4].gap" and "the scene has 3 [[contact.pairs]]" in missing.allowed
    assert "did you mean contact.pairs[1].gap?" in refusal(pairs, ["contact.pairs[1].gab=1e-5"]).allowed


def test_pairs_need_no_defaults_where_each_has_its_own(completed, refusal, changed, pairs):
    own = changed(pairs, *OWN_GAPS)
    every = changed(own, ("exponent = 100.0", "gap = -1e-5\nexponent = 100.0"))
    assert completed(every)["contact"]["pairs"][2]["gap"] == -1e-5
    error = refusal(own)
    assert (error.key, error.line) == ("contact.pairs[3].gap", 17)
    assert "missing; expected a number in m, here or in [contact]" in error.allowed


@pytest.mark.parametrize("old, new, line, key, allowed", [
    ("dofs = [3, 1] ", "# ", 10, "pairs[1].dofs", "missing; expected a list of integers"),
    ("[3, 1]", "[]", 11, "pairs[1].dofs", "there are 0"),
    ("[3, 1]", "[3, 4]", 11, "pairs[1].dofs", "no degree of freedom 4; expected 1..3"),
    ("[3, 1]", "[3, 0]", 11, "pairs[1].dofs", "out of range"),
    ("[3, 1]", "[3, -1]", 11, "pairs[1].dofs", 'side = "negative"'),
    ("[3, 1]", "[3, 3]", 11, "pairs[1].dofs", "twice; expected each once"),
    ("[3, 1]", "[3, 1.5]", 11, "pairs[1].dofs", "a list of integers"),
    ("[3, 1]", "3", 11, "pairs[1].dofs", "a list of integers"),
    (COEFFICIENTS, "[0.5, -1]", 18, "pairs[3].coefficients",
     "there are 2; expected a list of numbers, one for each of 3 dofs"),
    (COEFFICIENTS, "[0, 0, 0.0]", 18, "pairs[3].coefficients", "all are zero"),
    (COEFFICIENTS, "[1, nan, 0.0]", 18, "pairs[3].coefficients", "finite"),
    (COEFFICIENTS, "[]", 18, "pairs[3].coefficients", "there are 0"),
    ("coefficients = [0.5, -1, 2.0]", "# ", 16, "pairs[3].coefficients", "one for each of 3 dofs"),
    ('"negative"', '"left"', 19, "pairs[3].side", '"positive", "negative" or "both"'),
    ('"exponential"', '"rigid"', 20, "pairs[3].law", '"exponential", "linear", "bilinear"'),
    ("constant = 1e4", "#", 16, "pairs[3].constant", "missing; expected a number in N, > 0, here or in [contact]"),
    ("constant = 1e4", "constant = 0", 21, "pairs[3].constant", "> 0"),
    ('side = "both"', "exponent = 50", 14, "pairs[2].exponent", 'does not belong to a pair with the law "linear"'),
    ('side = "both"', 'sides = "both"', 14, "pairs[2].sides", "did you mean contact.pairs[2].side?"),
    ("gap = 5e-5", 'gap = "big"', 15, "pairs[2].gap", "a number in m"),
    ("gap = 2e-5", "gap = [2e-5, 1e-5]", 9, "gap", "may have its own gap; expected one number"),
    ("modal_damping = 0.1 ", "contact_dofs = [1] ", 5, "structure.contact_dofs", "[[contact.pairs]] too"),
])
def test_a_pair_that_is_wrong_is_an_error_at_its_place(refusal, changed, pairs, old, new, line, key, allowed):
    error = refusal(changed(pairs, (old, new)))
    assert (error.line, error.key) == (line, key if key.startswith("structure") else f"contact.{key}")
    assert allowed in error.allowed


@pytest.mark.parametrize("law", ["none", "rigid"])
def test_a_pair_has_no_law_of_its_own_beside_one_of_all_contacts(refusal, changed, pairs, law):
    text = changed(pairs, ('"linear"                  # 7', f'"{law}"'), ("stiffness = 1e6", "# "))
    if law == "none":
        text = changed(text, ("gap = 2e-5", "# "), ("gap = 5e-5", "# "))
    error = refusal(text)
    assert (error.key, error.line) == ("contact.pairs[3].law", 20)


def test_pairs_belong_to_matrices(refusal, changed, bar_text, chain_text, pairs):
    of_bar = refusal(changed(bar_text, ("[forcing]", "[[contact.pairs]]\ndofs = [1]\n[forcing]")))
    assert of_bar.key == "contact.pairs" and 'only with structure.type = "matrices"' in of_bar.allowed
    one_table = refusal(changed(chain_text, ("gap = 1e-4", "gap = 1e-4\npairs = [1, 2]\n#")))
    assert "expected tables [[contact.pairs]]" in one_table.allowed
    many = refusal(changed(pairs, ("[forcing]", "[[contact.pairs]]\ndofs = [1]\n" * 2001 + "[forcing]")))
    assert "there are 2004; expected at most 2000" in many.allowed
    none = refusal(changed(chain_text, ("contact_dofs = [2, 3]", "# ")))
    assert none.key == "structure.contact_dofs"
    assert "missing; expected a list of integers, or [[contact.pairs]]" in none.allowed


def test_pairs_are_described_as_contacts(scene_file, command, pairs):
    text = wb.check(scene_file(pairs))
    assert "linear and exponential laws at 4 contacts, gaps 20 µm to 50 µm" in text and "252 unknowns" in text
    assert "[[contact.pairs]]" in command("keys").text


def test_pairs_of_single_degrees_of_freedom_are_those_of_the_shorthand(solved, changed, chain_text):
    tables = '[[contact.pairs]]\ndofs = [2]\nside = "negative"\n[[contact.pairs]]\ndofs = [3]\n[forcing]'
    as_pairs = (("contact_dofs = [2, 3]", "# "), ("[forcing]", tables))
    short = ("[2, 3]", "[-2, 3]")
    damped = ["forcing.frequency=35", "structure.modal_damping=0.1", "contact.gap=5e-5", "time.functions=63"]
    expected, found = (solved(changed(chain_text, *one), damped) for one in ((short,), as_pairs))
    assert found.converged and expected.converged
    np.testing.assert_array_equal(found.contacts["displacement_m"], expected.contacts["displacement_m"])
    undamped = (('"linear"', '"rigid"'), ("stiffness = 1e7", "# "), ("modal_damping = 0.01", ""))
    a, b = (solved(changed(chain_text, *undamped, *one), ["analysis.type=nonlinear_mode"]).backbone
            for one in ((short,), as_pairs))
    assert a["status"] == b["status"]
    assert "converged" in a["status"] and len(a["frequency_ratio"]) == len(b["frequency_ratio"])
    known = np.array(a["status"]) == "converged"
    np.testing.assert_array_equal(a["energy_ratio"][known], b["energy_ratio"][known])


def test_pairs_move_as_time_stepping_says(solved, pairs):
    found = solved(pairs, ["time.functions=127"])
    reference = solved(pairs, ["analysis.type=time_stepping", "analysis.tolerance=1e-8"])
    assert found.converged and reference.converged, found.status
    a, b = (contact_of(one, "displacement_m") for one in (found, reference))
    error = np.linalg.norm(a - b, axis=1) / np.linalg.norm(b, axis=1)
    assert a.shape == (4, 1024) and np.all(error < 1e-4)
    assert np.all(contact_of(reference, "contact_force_N").max(axis=1) > 0.0)


def test_a_reduction_keeps_the_rows_that_pairs_touch_and_the_loaded_ones(solved, refusal, changed, scene_file, pairs):
    two = changed(pairs, ("dofs = [1, 2, 3]", "dofs = [2, 3]"), (COEFFICIENTS, "[0.5, -1]"),
                  ("dofs = [3, 1]", "dofs = [3, 2]"))
    kept = {modes: wb.check(scene_file(two), [f"structure.kept_modes={modes}"]) for modes in (0, 1)}
    assert "3 degrees of freedom, reduced to 2 (0 modes)" in kept[0] and "reduced to 3 (1 mode)" in kept[1]
    # Nothing is lost where all modes are kept.
    outputs = {"analysis.outputs": [1, 2, 3]}
    whole, reduced = solved(two, outputs), solved(two, {"structure.kept_modes": 1, **outputs})
    assert whole.converged and reduced.converged
    a, b = (contact_of(one, "displacement_m") for one in (whole, reduced))
    assert np.linalg.norm(a - b) < 1e-9 * np.linalg.norm(a)
    dofs = [values for name, values in reduced.outputs.items() if name != "time_fraction"]
    directions = np.array([[0.0, -1.0, 1.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -0.5, 1.0]])
    np.testing.assert_allclose(b, directions @ dofs, rtol=0.0, atol=4e-15 * np.abs(b).max())
    assert refusal(pairs, ["structure.kept_modes=0"]).key == "structure.kept_modes"


def test_pairs_are_swept_and_recorded_as_contacts(solved, pairs):
    response = solved(pairs)
    assert response.converged and response.contacts["contact"][-1] == 4.0
    sweep = solved(pairs, ["analysis.type=frequency_sweep", "analysis.frequency_from=30", "analysis.frequency_to=40",
                           "analysis.stability=false"])
    assert sweep.converged, sweep.status
    assert sweep.summary["max_contact_force_N"] > 1.0
