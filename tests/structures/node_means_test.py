"""A node of an expanded beam, which has several rows: contacts, loads and outputs use their mean."""

import numpy as np
import pytest

import wavebalance as wb

ROWS = 4  # of node 7 along z, then one of node 8
MASS = np.diag([1.0, 2.0, 0.5, 1.5, 3.0])
STIFFNESS = 1e5 * np.array([[4.0, -1, 0, 0, -1], [-1, 3, -1, 0, 0], [0, -1, 5, -1, 0], [0, 0, -1, 4, -1], [-1, 0, 0, -1, 6]])
MEAN = np.r_[np.full(ROWS, 0.25), 0.0]


@pytest.fixture
def beam(tmp_path, monkeypatch):
    """A scene of names; what it does not name is at row 5."""
    (tmp_path / "beam.dof").write_text("7.3\n7.3\n7.3\n7.3\n8.3\n")
    monkeypatch.chdir(tmp_path)
    return {"structure": {"type": "matrices", "mass": MASS, "stiffness": STIFFNESS, "dof_map": "beam.dof",
                          "stiffness_damping": 1e-4},
            "contact": {"law": "linear", "stiffness": 2e5, "gap": 3e-5, "pairs": [{"dofs": ["node 7 z"]}]},
            "forcing": {"amplitude": 40.0, "frequency": 30.0, "load_dofs": ["node 7 z"]},
            "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 512},
            "analysis": {"type": "forced_response", "outputs": ["node 7 z", "node 7 z #2", "velocity of node 7 z"]}}


def test_a_load_and_an_output_are_conjugate(beam):
    # Without contact the power of the load is its amplitude times the velocity of the mean.
    summary = wb.run(beam, {"contact.gap": 1.0}).summary
    w = 2.0 * np.pi * 30.0
    u = np.linalg.solve((1.0 + 1e-4j * w) * STIFFNESS - w**2 * MASS, 40.0 * MEAN)
    assert summary["node_7_z_amplitude_1_m"] == pytest.approx(abs(MEAN @ u), rel=1e-9)
    assert summary["node_7_z_2_amplitude_1_m"] == pytest.approx(abs(u[1]), rel=1e-9)
    phase = np.radians(summary["node_7_z_phase_1_degrees"])
    power = -0.5 * w * 40.0 * summary["node_7_z_amplitude_1_m"] * np.sin(phase)
    assert power == pytest.approx(0.5 * w**2 * 1e-4 * np.real(u.conj() @ STIFFNESS @ u), rel=1e-8)


def test_names_are_weights_of_rows(beam):
    rows = list(range(1, ROWS + 1))
    spelled = {"contact.pairs[1].dofs": rows, "contact.pairs[1].coefficients": [0.25] * ROWS,
               "forcing.load_dofs": rows, "forcing.load_coefficients": [0.25] * ROWS}
    named, same = (wb.run(beam, overrides).response["displacement_m"] for overrides in ({}, spelled))
    np.testing.assert_array_equal(named, same)
    assert named.max() > 3e-5


def test_two_nodes_face_each_other_by_their_means(beam):
    beam["contact"]["pairs"] = [{"dofs": ["node 7 z", "node 8 z"], "name": "baffle"}]
    spelled = {"contact.pairs[1].dofs": [1, 2, 3, 4, 5], "contact.pairs[1].coefficients": [0.25] * 4 + [-1.0]}
    named, same = (wb.run(beam, overrides) for overrides in ({}, spelled))
    np.testing.assert_array_equal(named.response["contact_force_N"], same.response["contact_force_N"])


def test_where_rows_stand_for_themselves_a_name_of_several_is_refused(beam):
    beam["contact"].pop("pairs")
    beam["structure"]["contact_dofs"] = ["node 7 z"]
    with pytest.raises(wb.SceneError) as refused:
        wb.run(beam)
    assert "4 rows of" in refused.value.allowed and "takes their mean" in refused.value.allowed


def reduced(modes):
    return {"structure.kept_modes": modes}


def test_a_reduction_keeps_one_coordinate_for_the_mean_of_a_node(beam):
    # With all modes of the rest, n - 1, it is exact.
    whole, same = wb.run(beam), wb.run(beam, reduced(4))
    assert same.summary["reduced_degrees_of_freedom"] == 5
    scale = np.abs(whole.response["displacement_m"]).max()
    np.testing.assert_allclose(same.response["displacement_m"], whole.response["displacement_m"], rtol=0.0,
                               atol=1e-10 * scale)
    assert scale > 3e-5
    for output in ("node_7_z", "node_7_z_2"):
        key = output + "_amplitude_1_m"
        assert same.summary[key] == pytest.approx(whole.summary[key], rel=1e-9, abs=0.0)


@pytest.mark.parametrize("loaded, kept", [(["node 7 z"], 1), (["node 7 z", "node 8 z"], 2), (["node 8 z"], 2),
                                          (["node 7 z #2"], 2), (["node 7 z #2", "node 7 z #3"], 2)])
def test_rows_that_a_load_takes_otherwise_than_a_contact_are_coordinates_of_their_own(beam, loaded, kept):
    # A load on one or two rows of the node leaves one coordinate for the others, and one for the loaded rows.
    beam["forcing"]["load_dofs"] = loaded
    record = wb.run(beam, reduced(5 - kept))
    assert record.summary["reduced_degrees_of_freedom"] == 5
    whole = wb.run(beam).response["contact_force_N"]
    np.testing.assert_allclose(record.response["contact_force_N"], whole, rtol=0.0, atol=1e-9 * max(1.0, whole.max()))
    with pytest.raises(wb.SceneError, match=f"expected at most {5 - kept}"):
        wb.run(beam, reduced(6 - kept))


def test_a_contact_at_one_row_of_several_is_warned_of(beam):
    assert not any("corner" in one for one in wb.run(beam).warnings)
    beam["contact"]["pairs"] = [{"dofs": ["node 7 z #2"]}, {"dofs": ["node 8 z"]}]
    (warning,) = [one for one in wb.run(beam).warnings if "corner" in one]
    assert warning.startswith('Contacts act at "node 7 z #2" alone')
    assert '"node 7 z" without the number is the mean of the node\'s 4 rows' in warning
    assert warning in wb.check(beam)
