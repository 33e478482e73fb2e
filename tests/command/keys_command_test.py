"""Keys of a scene as `wavebalance keys` lists them."""

import os
import re
import subprocess

import pytest

PROGRAM = os.environ["WAVEBALANCE_COMMAND"]


@pytest.fixture
def keys(command):
    """The text of the keys that the filters select, which must be there."""

    def ask(*filters):
        listed = command("keys", *filters)
        assert (listed.code, listed.errors) == (0, "")
        return listed.text

    return ask


def names_in(text):
    return [line[2:] for line in text.splitlines() if re.match("  [^ ]", line)]


def test_all_keys_are_described_and_named_one_per_line_with_their_choices(keys):
    described = [f"{part.split(']')[0]}.{name}" for part in re.split(r"^\[", keys(), flags=re.M)[1:]
                 for name in names_in(part) if not part.startswith("[")]
    names = keys("--names")
    assert [line.split()[0] for line in names.splitlines()] == described
    assert "\ncontact.gap\n" in names
    assert "\nstructure.free true false\n" in names
    for section in ("[[contact.pairs]]", "[[forcing.terms]]"):
        assert f"\n{section}, any number of " in keys()


def test_full_standard_output_is_two():
    with open("/dev/full", "w", encoding="utf-8") as full:
        ended = subprocess.run([PROGRAM, "keys"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert ended.returncode == 2
    assert ended.stderr == "wavebalance: standard output: cannot be written: No space left on device\n"


def test_keys_of_sections_are_those_alone(keys):
    forcing = keys("forcing")
    assert forcing.startswith("[[forcing.terms]]")
    assert "\n[forcing]\n" in forcing and "[time]" not in forcing
    assert keys("time").startswith("[time]\n")
    several = keys("forcing", "analysis", "time")
    assert [name for name in ("[forcing]", "[analysis]", "[time]") if name not in several] == []
    assert "[structure]" not in several


def test_keys_of_a_choice_leave_out_what_such_a_scene_may_not_hold(keys):
    names = set(names_in(keys("structure", "structure.type=matrices")))
    assert {"mass", "type", "stiffness_damping"} <= names
    assert not names & {"youngs_modulus", "elements"}


def test_keys_of_a_law_are_its_own_parameters_as_it_has_them(keys):
    text = keys("contact", "contact.law=linear")
    assert names_in(text) == ["dofs", "coefficients", "side", "law", "name", "unit", "stiffness", "gap",
                              "law", "stiffness", "gap", "form", "mass"]
    assert "slope of the linear law.\n" in text
    assert "clearance law" not in text


def test_tangents_are_those_of_a_law_with_friction(keys):
    assert {"tangent", "tangent_coefficients", "second_tangent", "second_tangent_coefficients", "friction"} <= set(
        names_in(keys("contact", "contact.law=coulomb")))


@pytest.mark.parametrize("filters, names", [
    (["gap"], ["gap", "gap"]),
    (["contact.gap"], ["gap"]),
    (["contact.gap", "forcing.frequency"], ["gap", "frequency"]),
], ids=str)
def test_keys_of_a_name_are_all_of_this_name(keys, filters, names):
    assert names_in(keys(*filters)) == names


@pytest.mark.parametrize("filters, answer", [
    (["contcat"], "did you mean contact?"),
    (["structure.type=matrix"], 'structure.type may be "bar", "blade" or "matrices"'),
    (["contact.gap=1"], "expected one of structure.type"),
    (["structure.area", "structure.type=matrices"], "such a scene has none of these"),
], ids=str)
def test_wrong_filters_are_answered_with_what_is_allowed(command, filters, answer):
    refused = command("keys", *filters)
    assert refused.code == 2
    assert answer in refused.errors
