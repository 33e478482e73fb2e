"""A blade whose tip rubs on its casing: each corner node has a radial direction and a tangent."""

import base64
import re

import numpy as np
import pytest

import wavebalance as wb

MOTION_POINTS = 16
FEWER = ["structure.chord_elements=3", "structure.span_elements=6", "time.functions=15", "time.quadrature_points=128",
         "analysis.stability=false", "analysis.phases=false", f"analysis.motion_points={MOTION_POINTS}"]


@pytest.fixture(scope="module")
def solve(scenes_folder):
    """The record of a scene of the blade with fewer elements, which converged."""

    def record(name, *overrides):
        found = wb.run(scenes_folder / "blade" / name, [*overrides, *FEWER])
        assert found.converged, found.status
        return found

    return record


@pytest.fixture(scope="module")
def pressed(solve):
    return solve("forced_fourier.toml")


def along(record, direction):
    """Displacements of the contacts along a direction, times x contacts."""
    contacts = record.contacts
    rows = np.array(contacts.get("direction", ["normal"] * len(contacts["contact"]))) == direction
    return contacts["displacement_m"][rows].reshape(-1, 8)


def arrays_of(file):
    """Places and displacements of the nodes in a file of ParaView."""
    text = file.read_text()
    data = text[text.index('encoding="base64">\n_') + len('encoding="base64">\n_'):]
    found = {}
    for name in ("points", "displacement"):
        offset = int(re.search(rf'Name="{name}".*offset="(\d+)"', text).group(1))
        size = int.from_bytes(base64.b64decode(data[offset:offset + 12])[:8], "little")
        block = base64.b64decode(data[offset:offset + 4 * -(-(size + 8) // 3)])
        found[name] = np.frombuffer(block[8:8 + size]).reshape(-1, 3)
    return found


@pytest.mark.parametrize("axis", [0, 1])
def test_each_corner_node_of_the_tip_rubs_across_its_radius(solve, tmp_path, axis):
    record = solve("rubbing.toml", f"contact.tangent={'xy'[axis]}")
    assert record.summary["contacts"] == 8 and record.summary["contact_directions"] == 16
    record.write(tmp_path)
    nodes = [arrays_of(tmp_path / f"motion_{k:04}.vtu") for k in range(MOTION_POINTS)]
    places = nodes[0]["points"]
    (tip,) = np.nonzero(places[:, 2] >= places[:, 2].max() - 1e-9)
    motion = np.array([one["displacement"][tip] for one in nodes])
    step = len(along(record, "normal")) // MOTION_POINTS
    normals, tangents = (along(record, one)[::step] for one in ("normal", "tangent"))
    size, rubbing = np.abs(motion).max(), []
    for normal, tangent in zip(normals.T, tangents.T):
        differences = motion[:, :, [2, axis]] - np.stack([normal, tangent], axis=-1)[:, None, :]  # z is radial
        apart = np.abs(differences).max(axis=(0, 2))
        rubbing.append(np.argmin(apart))
        assert apart.min() <= 1e-12 * size
    assert len(set(rubbing)) == 8


def test_without_friction_the_response_is_that_of_an_elastic_casing(solve, pressed):
    smooth, rough = solve("rubbing.toml", "contact.friction=0"), solve("rubbing.toml")
    displacement = along(pressed, "normal")
    assert displacement.max() > 2e-4, "the tip does not reach the casing"
    np.testing.assert_allclose(along(smooth, "normal"), displacement, rtol=0.0, atol=1e-9 * displacement.max())
    assert smooth.summary["friction_work_J"] == 0.0
    assert along(rough, "normal").max() < displacement.max()
    assert rough.summary["friction_work_J"] > 0.0


@pytest.mark.parametrize("name, setting, allowed", [
    ("rubbing.toml", "contact.tangent=z", '"x" or "y"'),
    ("forced_fourier.toml", "contact.tangent=x", "coulomb"),
    ("rubbing.toml", "contact.normal_stiffness=0", "> 0"),
])
def test_a_tangent_that_is_radial_or_without_friction_is_refused(scenes_folder, name, setting, allowed):
    with pytest.raises(wb.SceneError) as raised:
        wb.complete(scenes_folder / "blade" / name, [setting, *FEWER])
    assert allowed in f"{raised.value.key} {raised.value.allowed}"
