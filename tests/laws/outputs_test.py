"""Outputs: degrees of freedom and contacts whose motion a record shows."""

import numpy as np
import pytest

import wavebalance as wb

STIFFNESS = np.array([[2e6, -1e6, 0.0], [-1e6, 2e6, -1e6], [0.0, -1e6, 1e6]])
SWEEP = ["analysis.type=frequency_sweep", "analysis.frequency_from=40", "analysis.frequency_to=90",
         "analysis.stability=false"]
FIRST = 'analysis.outputs=["node 7 z"]'  # the first mass of the chain


@pytest.fixture
def mapped(changed, chain_text, tmp_path):
    """The chain with names of nodes."""
    (tmp_path / "chain.dof").write_text("7.3\n20.3\n4.5\n")
    return changed(chain_text, ("modal_damping = 0.01", 'dof_map = "chain.dof"\nmodal_damping = 0.01'))


@pytest.fixture
def solve(solved, mapped):
    """The record of the chain with other values, which converged."""

    def record(*overrides, unset=()):
        found = solved(mapped, overrides, unset)
        assert found.converged, found.status
        return found

    return record


def test_outputs_of_a_linear_structure_are_its_transfer_function(solve):
    # Without contact the response of the chain is (K - w^2 M + i w C)^-1 f, here with C = beta K.
    sweep = solve(*SWEEP, 'analysis.outputs=["node 7 z", "-node 4 ry"]', "contact.gap=1.0",
                  "analysis.output_harmonics=2", "structure.modal_damping=0", "structure.stiffness_damping=2e-5").sweep
    w = 2.0 * np.pi * sweep["frequency_Hz"][:, None, None]
    dynamic = (1.0 + 2e-5j * w) * STIFFNESS - 2.0 * w**2 * np.eye(3)
    first, _, last = np.linalg.solve(dynamic, np.array([[[0.0], [0.0], [100.0]]]))[:, :, 0].T
    amplitude = sweep["node_7_z_amplitude_1_m"]
    np.testing.assert_allclose(amplitude, np.abs(first), rtol=1e-9)
    turn = np.remainder(sweep["node_7_z_phase_1_degrees"] - np.degrees(np.angle(first)) + 180.0, 360.0) - 180.0
    np.testing.assert_allclose(turn, 0.0, atol=1e-6)
    np.testing.assert_allclose(sweep["node_7_z_half_peak_to_peak_m"], amplitude, rtol=1e-4)
    assert np.all(sweep["node_7_z_amplitude_2_m"] <= 1e-10 * amplitude)
    np.testing.assert_allclose(sweep["minus_node_4_ry_amplitude_1_rad"], np.abs(last), rtol=1e-9)


def test_outputs_of_contacts_are_their_own_extremes_means_and_forces(solve):
    record = solve(*SWEEP)
    sweep, second = record.sweep, record.sweep["contact_2_max_rad"]
    np.testing.assert_array_equal(np.maximum(sweep["contact_1_max_m"], second), sweep["max_displacement_m"])
    np.testing.assert_allclose(sweep["contact_2_half_peak_to_peak_rad"], 0.5 * (second - sweep["contact_2_min_rad"]),
                               rtol=0.0, atol=1e-18)
    assert sweep["max_contact_force_N"].max() > 0.0
    assert record.summary["outputs"]["output"] == ["contact 1", "contact 2"]


@pytest.mark.parametrize("shown", ["true", "false"])
def test_outputs_of_the_contacts_are_left_out_where_the_scene_says_so(solve, tmp_path, shown):
    record = solve(*SWEEP, f"analysis.contact_outputs={shown}")
    assert ("contact_1_max_m" in record.sweep) == (shown == "true")
    record.write(tmp_path / "out")
    assert bool(list((tmp_path / "out").glob("outputs*.svg"))) == (shown == "true")


def test_outputs_of_a_reduced_structure_with_all_its_modes_are_the_same(solve):
    whole, modes = (solve(*SWEEP, FIRST, "contact.gap=2e-4", *more).summary["outputs"]["half_peak_to_peak"][0]
                    for more in ((), ("structure.kept_modes=1",)))
    assert modes == pytest.approx(whole, rel=1e-3)


def test_the_peak_of_an_output_may_choose_the_motion_that_is_written(solve):
    # The first mass of the chain vibrates most at another frequency than the last one.
    def peaks(*more):
        summary = solve(SWEEP[0], SWEEP[1], SWEEP[3], "analysis.frequency_to=220", "analysis.motion_at=peak",
                        "contact.gap=1.0", FIRST, "structure.modal_damping=0.05", "forcing.load_dofs=[1]",
                        *more).summary
        return summary["motions"]["frequency_Hz"][0], summary["outputs"]["frequency_Hz"][0]

    by_contacts, best = peaks()
    by_output, same = peaks('analysis.peak_of="node 7 z"')
    assert by_output == same == best != by_contacts


def test_outputs_of_a_response_are_its_motion_over_the_period(solve):
    record = solve('analysis.outputs=["node 20 z"]', "analysis.contact_outputs=true")
    assert list(record.outputs) == ["time_fraction", "node_20_z_m", "contact_1_m", "contact_2_rad"]
    node = record.outputs["node_20_z_m"]
    np.testing.assert_allclose(node, record.outputs["contact_1_m"], rtol=0.0, atol=1e-12)
    table = record.summary["outputs"]
    assert len(table["output"]) == 3 and table["max"][0] == pytest.approx(node.max(), abs=1e-15)


def test_outputs_of_time_stepping_are_near_those_of_the_balance(solve):
    balance, stepped = (solve(FIRST, "structure.modal_damping=0.05", how).summary["outputs"]["rms"][0]
                        for how in ("time.functions=127", "analysis.type=time_stepping"))
    assert stepped == pytest.approx(balance, rel=1e-3)


def test_outputs_of_an_exact_curve_over_the_amplitude_are_those_of_a_fine_balance(solve):
    # With much damping both curves pass every place once.
    exact, fine = (solve("analysis.type=amplitude_sweep", "analysis.amplitude_from=50", "analysis.amplitude_to=300",
                         FIRST, "structure.modal_damping=0.1", "analysis.stability=false", "time.functions=127",
                         "time.quadrature_points=512", "analysis.largest_step=1", f"analysis.exact={how}").sweep
                   for how in ("true", "false"))
    assert exact["contact_1_contact_fraction"][-1] > 0.0
    for column in ("node_7_z_half_peak_to_peak_m", "node_7_z_amplitude_2_m", "contact_1_max_force_N"):
        values, places = exact[column], fine["amplitude_N"]
        assert np.all(np.diff(places) > 0.0)
        distance = np.abs(np.interp(exact["amplitude_N"], places, fine[column]) - values).max()
        assert distance <= 1e-3 * np.abs(values).max(), column


def test_outputs_of_a_curve_with_impacts_are_those_of_its_motions_without_forces(solved, solve, mapped):
    rigid = ("contact.law=rigid", "contact.restitution=0.7", FIRST, "structure.modal_damping=0.05")
    unset = ("contact.stiffness", "time.trial", "time.weight", "time.functions")
    sweep = solved(mapped, [*rigid, SWEEP[0], SWEEP[1], "analysis.frequency_to=60", SWEEP[3]], unset).sweep
    response = solve(*rigid, "forcing.frequency=40", unset=unset).summary
    assert response["impacts"] > 0.0
    for column in ("half_peak_to_peak", "rms", "amplitude_1"):
        assert sweep[f"node_7_z_{column}_m"][0] == pytest.approx(response["outputs"][column][0], rel=1e-6)
    assert np.isnan(sweep["contact_1_max_force_N"][0])


@pytest.mark.parametrize("overrides, part", [
    (['analysis.outputs=["node 8 z"]'], "node 8 is not in"),
    (["analysis.outputs=[4]"], "expected 1..3"),
    (["analysis.outputs=[1, -1]"], "is there twice"),
    ([*SWEEP, 'analysis.peak_of="node 8 z"'], "expected one of the outputs, which are contact 1, contact 2"),
    ([*SWEEP, 'analysis.peak_of="contact 1"', "analysis.contact_outputs=false"], "there are no outputs"),
    ([*SWEEP, "analysis.output_harmonics=600"], "less than half of analysis.output_points"),
])
def test_an_output_that_is_wrong_is_named(refusal, mapped, overrides, part):
    assert part in refusal(mapped, overrides).allowed


def test_outputs_are_written_and_read_back(scene_file, completed, mapped):
    overrides = [*SWEEP, 'analysis.outputs=["-node 7 z", 2]', 'analysis.peak_of="-node 7 z"']
    analysis = completed(mapped, overrides)["analysis"]
    text = wb.complete(scene_file(mapped), overrides)
    assert wb.complete(text) == text
    assert analysis["outputs"] == ["-node 7 z", "row 2"] and analysis["peak_of"] == "-node 7 z"
