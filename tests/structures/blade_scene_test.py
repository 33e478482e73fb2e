"""Blades as scenes: defaults, sizes, and what is refused."""

import tomllib

import numpy as np
import pytest
from structure_scenes import BLADE, MATRICES, changed, node_displacements, refused

import wavebalance as wb

SWEEP = MATRICES.parent / "blade" / "sweep.toml"
# The blade of this project, a substitute for the blade of Laxalde and Legrand (2010), section 5.2: fem's BladeOptions.
OPEN_BLADE = {
    "chord": [0.052, 0.056], "thickness_ratio": [0.09, 0.031], "camber_ratio": [0.098, 0.011],
    "angle_degrees": [10.0, 35.0], "edge_thickness": 0.35, "length": 0.091, "youngs_modulus": 1.1e11,
    "poissons_ratio": 0.31, "density": 4430.0, "element": "hexahedron20", "chord_elements": 11,
    "thickness_elements": 1, "span_elements": 16, "kept_modes": 40,
}


def test_the_type_alone_is_the_open_blade():
    scene = tomllib.loads(wb.complete(BLADE))
    assert {key: scene["structure"][key] for key in OPEN_BLADE} == OPEN_BLADE
    assert scene["analysis"]["motion_points"] == 32
    said = wb.check(BLADE)
    assert "3936 degrees of freedom, reduced to 112 (40 modes)" in said
    assert "rigid obstacle at 24 degrees of freedom" in said
    written = wb.complete(BLADE)
    assert wb.complete(written) == written


@pytest.mark.parametrize("overrides, counted", [
    # 24 contacts: counts of 15 functions cost three points of the curve, of 63 functions tens of them.
    ({"time.functions": 15}, True),
    ({"time.functions": 63}, False),
    ({"time.functions": 63, "analysis.stability": True}, True),
    ({"time.functions": 63, "structure.chord_elements": 2}, True),
])
def test_multipliers_are_counted_along_curves_by_default_where_that_costs_a_few_points(overrides, counted):
    assert tomllib.loads(wb.complete(SWEEP, overrides))["analysis"]["stability"] is counted


@pytest.mark.parametrize("line, key, part", [
    ("chord = [0.05]", "structure.chord", "there are 1; expected a list of 2 numbers in m, > 0"),
    ("chord = [0.05, -1]", "structure.chord", "out of range"),
    ('element = "hexahedron"', "structure.element", "did you mean"),
    ("kept_modes = 4000", "structure.kept_modes", "at most 3864"),
    ("rotation_axis = [0, 0, 0]", "structure.rotation_axis", "not zero"),
    ("poissons_ratio = 0.5", "structure.poissons_ratio", "out of range"),
    ("area = 1", "structure.area", 'only with structure.type = "bar"'),
])
def test_a_wrong_value_is_refused_at_its_line(line, key, part):
    refused(changed(BLADE, ("[contact]", line + "\n[contact]")), key, part, line=3)


def free_nodes(chord, thickness, span, mid_edges):
    """Nodes of a block of hexahedra, held at the root."""
    corners = (chord + 1) * (thickness + 1) * span
    if not mid_edges:
        return corners
    across = chord * (thickness + 1) + (chord + 1) * thickness  # mid edges of one section
    return corners + across * span + (chord + 1) * (thickness + 1) * span


@pytest.mark.parametrize("element", ["hexahedron20", "hexahedron20_reduced", "hexahedron8"])
def test_the_unknowns_are_those_of_the_mesh(element, tmp_path):
    scene = changed(BLADE, ('"rigid"', '"linear"\nstiffness = 1e6'), ("nonlinear_mode", "forced_response")) + """
[forcing]
amplitude = 1.0
frequency = 100.0
[time]
trial = "fourier"
weight = "fourier"
functions = 7
"""
    overrides = {"structure.chord_elements": 3, "structure.thickness_elements": 2, "structure.span_elements": 4,
                 "structure.element": element, "structure.kept_modes": 4, "analysis.phases": False,
                 "analysis.stability": False, "analysis.motion_points": 2}
    record = wb.run(scene, overrides, output=tmp_path / "out")
    unknowns = 3 * free_nodes(3, 2, 4, element != "hexahedron8")
    moved = node_displacements(tmp_path / "out" / "motion_0000.vtu")
    assert 3 * np.count_nonzero(moved.any(axis=1)) == unknowns
    assert record.summary["degrees_of_freedom"] == unknowns
    assert f", {unknowns} degrees of freedom" in wb.check(scene, overrides)
    assert record.summary["contacts"] == 2 * (3 + 1)  # corners of the tip on its two faces
    assert "at 8 degrees of freedom" in wb.check(scene, overrides)
